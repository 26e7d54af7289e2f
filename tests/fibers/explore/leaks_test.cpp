// SPDX-License-Identifier: BSD-3-Clause
// Bodies that leave something behind for the next schedule: state, or memory.
#include <gtest/gtest.h>
#include <malloc.h>

#include <array>
#include <memory>
#include <string>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Sanitizers and valgrind have heaps of their own.
bool the_heap_is_counted() {
  const std::size_t before = mallinfo2().uordblks;
  const auto block = std::make_unique<std::array<char, 4096>>();
  block->back() = 1;
  return mallinfo2().uordblks > before;
}

TEST(Explore, ABodyThatFailsInTheDefaultOrderOnlyLaterIsSaidToLeak) {
  int runs = 0;
  const ExploreReport report = explore([&] { check(++runs < 200, "too many"); });
  EXPECT_TRUE(contains(report.text, "which passed at first, fails now: the body leaks state")) << report;
}

TEST(Explore, ABodyThatLeaksStateIsNamedWithTheFirstDifference) {
  int runs = 0;
  const ExploreReport report = explore([&] {
    if (++runs % 2 == 0) this_thread::yield();
  });
  EXPECT_FALSE(report.passed);
  EXPECT_TRUE(contains(report.text, "the body leaks state from one schedule into the next")) << report;
  EXPECT_TRUE(contains(report.text, "'main#0 yield")) << report;
}

TEST(Explore, MemoryThatEachScheduleLeavesIsCounted) {
  std::vector<std::unique_ptr<int[]>> kept;
  kept.reserve(20'000);
  const ExploreReport leaking = explore([&] { kept.push_back(std::make_unique<int[]>(100)); });
  EXPECT_TRUE(leaking.passed) << leaking;
  if (the_heap_is_counted()) {
    EXPECT_GE(leaking.leaked_bytes, 400U);
    EXPECT_LT(leaking.leaked_bytes, 500U);
  }
  EXPECT_EQ(explore([] { thread([] {}).join(); }).leaked_bytes, 0U);
}

}  // namespace
}  // namespace waitpoint
