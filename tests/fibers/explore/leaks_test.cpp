// SPDX-License-Identifier: BSD-3-Clause
// Bodies that leak state or memory into the next schedule.
#include <gtest/gtest.h>
#include <malloc.h>

#include <array>
#include <memory>
#include <string>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint {
namespace {

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
  EXPECT_TRUE(contains(report.text, "the same schedule gives another run. The body leaks state")) << report;
}

// The default order does not reach the state, so only a fresh process shows the leak.
TEST(Explore, ABodyThatLeaksStateWhereOnlyOtherOrdersComeIsSaidToLeak) {
  int late = 0;
  const ExploreReport report = explore([&] {
    atomic<bool> told(false);
    thread other([&] { told.store(true); });
    if (told.load()) check(++late < 20, "too often late");
    other.join();
  });
  EXPECT_FALSE(report.passed);
  EXPECT_TRUE(contains(report.text, "too often late")) << report;
  EXPECT_TRUE(contains(report.text, "the same schedule gives another run. The body leaks state")) << report;
  EXPECT_FALSE(contains(report.text, "WAITPOINT_REPLAY")) << report;
}

// An action of the first failing schedule alone shows when the failure is minimised.
TEST(Explore, ABodyThatMakesSomethingOnceInARareOrderIsSaidToLeak) {
  bool is_made = false;
  const ExploreReport report = explore([&] {
    atomic<bool> told(false);
    thread other([&] { told.store(true); });
    if (told.load()) {
      if (!is_made) this_thread::yield();
      is_made = true;
      check(false, "never so early");
    }
    other.join();
  });
  EXPECT_TRUE(contains(report.text, "the same schedule gives another run. The body leaks state")) << report;
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

// Each run is judged: the first ones in the default order, those that look for leaks, the search's, the last one.
TEST(Explore, AFailureOfAnySingleRunFailsTheReport) {
  int runs = 0, failing = -1;
  const auto body = [&] {
    const int run = runs++;
    mutex lock;
    thread other([&] {
      lock.lock();
      lock.unlock();
    });
    lock.lock();
    lock.unlock();
    other.join();
    check(run != failing, "that run");
  };
  const ExploreReport passing = explore(body, {.iterations = 20});
  EXPECT_TRUE(passing.passed) << passing;
  const int all = runs;
  EXPECT_GT(all, 50);
  for (failing = 0; failing < all; ++failing) {
    runs = 0;
    const ExploreReport report = explore(body, {.iterations = 20});
    EXPECT_FALSE(report.passed) << "run " << failing;
    EXPECT_TRUE(contains(report.text, "that run")) << report;
  }
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
