// SPDX-License-Identifier: BSD-3-Clause
// Random litmus tests have exactly the outcomes of the axioms.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "core/random.hpp"
#include "tests/fibers/explore/weak_memory/executions.hpp"
#include "tests/fibers/explore/weak_memory/outcomes.hpp"

namespace waitpoint::weak_memory {
namespace {

class RandomLitmus {
 public:
  explicit RandomLitmus(std::uint64_t seed) : random_(seed, "litmus", "program") {}

  Litmus made() {
    Litmus litmus(2 + below(2));
    for (std::vector<Step>& thread : litmus) {
      const std::size_t steps = litmus.size() == 2 ? 2 + below(3) : 1 + below(3);
      while (thread.size() < steps) thread.push_back(step());
    }
    return litmus;
  }

 private:
  std::size_t below(std::size_t bound) { return static_cast<std::size_t>(random_.below(bound, drawn_++, 0)); }
  template <std::size_t N>
  std::memory_order one_of(const std::memory_order (&orders)[N]) {
    return orders[below(N)];
  }

  Step step() {
    constexpr std::memory_order loads[] = {relaxed, relaxed, acquire, seq_cst};
    constexpr std::memory_order stores[] = {relaxed, relaxed, release, seq_cst};
    constexpr std::memory_order updates[] = {relaxed, acquire, release, acq_rel, seq_cst};
    constexpr std::memory_order fences[] = {acquire, release, acq_rel, seq_cst, seq_cst, seq_cst};
    const int location = static_cast<int>(below(2));
    switch (below(9)) {
      case 0:
      case 1:
      case 2: return load(location, one_of(loads));
      case 3:
      case 4:
      case 5: return store(location, ++stored_, one_of(stores));
      case 6: return add(location, 10, one_of(updates));
      case 7: return exchange(location, ++stored_, one_of(updates));
      default: return fence(one_of(fences));
    }
  }

  RandomStream random_;
  std::uint64_t drawn_ = 0;
  int stored_ = 0;
};

TEST(RandomLitmus, HasTheOutcomesOfTheAxioms) {
  constexpr std::uint64_t programs = 40;
  std::uint64_t where_more_is_allowed = 0;
  for (std::uint64_t seed = 1; seed <= programs; ++seed) {
    const Litmus litmus = RandomLitmus(seed).made();
    const Outcomes expected = executable(litmus), all = allowed(litmus);
    const Explored found = explored(litmus, "dpor", Memory::weak);
    ASSERT_EQ(found.text, "") << text_of(litmus);
    EXPECT_EQ(found.outcomes, expected) << "program " << seed << ": " << text_of(litmus) << "\n"
                                        << text_of(found.outcomes) << "\ninstead of\n"
                                        << text_of(expected);
    EXPECT_TRUE(std::includes(all.begin(), all.end(), expected.begin(), expected.end())) << text_of(litmus);
    where_more_is_allowed += expected != all;
  }
  EXPECT_LT(where_more_is_allowed, programs / 4);
}

}  // namespace
}  // namespace waitpoint::weak_memory
