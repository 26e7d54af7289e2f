// SPDX-License-Identifier: BSD-3-Clause
// Built into two programs: with simulated threads, and with WAITPOINT_REAL_THREADS defined for all its files.
#include "tests/fibers/sync/same_source.hpp"

#include <gtest/gtest.h>

#ifndef WAITPOINT_REAL_THREADS
#include "tests/fibers/sync/orders.hpp"
#endif

namespace waitpoint {
namespace {

SameSourceOutcome expected() {
  SameSourceOutcome outcome;
  for (int producer = 0; producer < 3; ++producer)
    for (int i = 0; i < 30; ++i) outcome.consumed.push_back(100 * producer + i);
  outcome.ticks = 20;
  outcome.first_dues = {1, 2, 3};
  outcome.ticks_while_busy = 5;
  outcome.threads_with_own_id = 5;
  return outcome;
}

void expect_as_expected(const SameSourceOutcome& outcome) {
  EXPECT_EQ(outcome.consumed, expected().consumed);
  EXPECT_TRUE(outcome.each_producer_in_order);
  EXPECT_EQ(outcome.ticks, expected().ticks);
  EXPECT_EQ(outcome.first_dues, expected().first_dues);
  EXPECT_EQ(outcome.ticks_while_busy, expected().ticks_while_busy);
  EXPECT_TRUE(outcome.timeouts_came);
  EXPECT_TRUE(outcome.times_were_kept);
  EXPECT_EQ(outcome.threads_with_own_id, expected().threads_with_own_id);
}

#ifdef WAITPOINT_REAL_THREADS
TEST(SameSource, DoesTheSameOnRealThreads) {
  // A loaded machine may miss ticks: the test is of the program, not of the machine's timing.
  SameSourceOutcome outcome;
  for (int attempt = 0; attempt < 10 && !(outcome == expected()); ++attempt) outcome = run_same_source();
  expect_as_expected(outcome);
}
#else
TEST(SameSource, DoesTheSameOnSimulatedThreads) {
  in_every_order([] { expect_as_expected(run_same_source()); });
}
#endif

}  // namespace
}  // namespace waitpoint
