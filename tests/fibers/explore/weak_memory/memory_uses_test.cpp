// SPDX-License-Identifier: BSD-3-Clause
// The bounds of weak memory, and memory that is not accessed atomically alone. This file is not instrumented.
#include "tests/fibers/explore/weak_memory/memory_uses.hpp"

#include <gtest/gtest.h>

#include "fibers/explore/explore.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint::weak_memory {
namespace {

void holds(void (*body)()) {
  const ExploreReport report = explore_with(nullptr, body, {.iterations = 1500, .memory = Memory::weak});
  EXPECT_TRUE(report.passed) << report;
}

TEST(WeakMemory, EndsLoopsThatReadAnOlderValueAgainAndAgain) {
  const ExploreReport report =
      explore_with(nullptr, wait_for_a_flag, {.strategy = "dfs", .iterations = 100'000, .memory = Memory::weak});
  EXPECT_TRUE(report.passed) << report;
  EXPECT_FALSE(report.complete);
  EXPECT_TRUE(contains(report.scope, values_left_out)) << report.scope;
}

TEST(WeakMemory, SaysThatOldStoresAreLeftOut) {
  const ExploreReport report = explore_with(nullptr, store_often, {.strategy = "dpor", .memory = Memory::weak});
  EXPECT_TRUE(report.passed) << report;
  EXPECT_FALSE(report.complete);
  EXPECT_TRUE(contains(report.scope, values_left_out)) << report.scope;
  EXPECT_TRUE(explore_with(nullptr, store_often, {.strategy = "dpor", .memory = Memory::sc}).complete);
}

TEST(WeakMemory, BeginsAnewWithANewObject) { holds(reuse_memory); }
TEST(WeakMemory, HasTheValuesOfPlainStores) { holds(modify_plainly); }
TEST(WeakMemory, HasTheNewestValuesOfAccessesOfTwoSizes) { holds(access_in_two_sizes); }
TEST(WeakMemory, KnowsTheLocksOfStatics) { holds(construct_a_static); }

}  // namespace
}  // namespace waitpoint::weak_memory
