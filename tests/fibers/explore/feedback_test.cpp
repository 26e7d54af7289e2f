// SPDX-License-Identifier: BSD-3-Clause
// Strategies that learn from earlier schedules: what they find by it, and that their schedules repeat.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "fibers/explore/explore.hpp"
#include "fibers/explore/schedules/token.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

// Fails only if the reader is in turns before and behind the writer, at each of many variables; else it ends at once.
void alternate() {
  constexpr std::size_t stages = 9;
  std::array<atomic<bool>, stages> written;
  std::size_t reached = 0;
  thread writer([&] {
    for (atomic<bool>& stage : written) stage.store(true);
  });
  thread reader([&] {
    while (reached < stages && written[reached].load() == (reached % 2 != 0)) ++reached;
  });
  writer.join();
  reader.join();
  check(reached < stages, "they have alternated");
}

ExploreReport explored(const std::string& strategy, std::uint64_t seed, const std::string& replay = "") {
  return explore(alternate,
                 {.strategy = strategy, .seed = seed, .iterations = 10'000, .replay = replay, .minimize = false});
}

TEST(Feedback, LeadsStepByStepToARareOrder) {
  std::uint64_t by_feedback = 0, without = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    by_feedback += explored("rff", seed).schedules;
    without += explored("pos", seed).schedules;
  }
  EXPECT_LT(by_feedback * 2, without);
}

TEST(Feedback, ATokenByNumberRepeatsTheSchedulesBefore) {
  for (const std::string strategy : {"rff", "portfolio"}) {
    const ExploreReport report = explored(strategy, 3);
    ASSERT_FALSE(report.passed);
    exploration::Token token = exploration::read_token(report.replay);
    token.strategy = strategy;
    token.seed = 3;
    token.number = report.failed_at;
    token.deviations.clear();
    ++token.call;  // the next one in this test
    const ExploreReport again = explored(strategy, 3, to_text(token));
    EXPECT_EQ(again.schedules, 1U);
    EXPECT_NE(again.text.find("they have alternated"), std::string::npos) << again.text;
    EXPECT_EQ(again.text.find("belongs to another run"), std::string::npos) << again.text;
  }
}

}  // namespace
}  // namespace waitpoint
