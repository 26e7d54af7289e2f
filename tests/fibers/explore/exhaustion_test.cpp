// SPDX-License-Identifier: BSD-3-Clause
// Campaigns that have tried all: draws that bring nothing new are followed by an enumeration, which ends them.
#include "fibers/explore/schedules/exhaustion.hpp"

#include <gtest/gtest.h>

#include <array>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/explore/alternation.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint {
namespace {

using exploration::Exhaustion;

TEST(Exhaustion, BeginsWhenManyDrawnSchedulesWereKnown) {
  Exhaustion exhaustion;
  for (std::uint64_t trace = 0; trace < 100; ++trace) exhaustion.take_drawn(trace, false);
  for (std::uint64_t i = 0; i < 299; ++i) exhaustion.take_drawn(i % 100, false);
  EXPECT_FALSE(exhaustion.has_begun());
  exhaustion.take_drawn(100, false);  // a new one
  for (std::uint64_t i = 0; i < 302; ++i) exhaustion.take_drawn(i % 100, false);
  EXPECT_FALSE(exhaustion.has_begun());
  exhaustion.take_drawn(0, false);
  EXPECT_TRUE(exhaustion.has_begun());
  EXPECT_EQ(exhaustion.distinct(), 101U);
}

TEST(Exhaustion, EnumeratesAsManyAsWereDrawnThenInTurn) {
  Exhaustion exhaustion;
  for (std::uint64_t i = 0; i <= Exhaustion::least_known; ++i) exhaustion.take_drawn(1, false);
  std::uint64_t enumerated = 0;
  for (; exhaustion.is_next_enumerated(); ++enumerated) exhaustion.take_enumerated(1);
  EXPECT_EQ(enumerated, Exhaustion::least_known + 1);
  exhaustion.take_drawn(1, false);
  EXPECT_TRUE(exhaustion.is_next_enumerated());
  exhaustion.take_cut();
  EXPECT_FALSE(exhaustion.is_next_enumerated());
}

TEST(Exhaustion, AnEnumerationThatMissesWhatWasDrawnProvesNothing) {
  Exhaustion exhaustion;
  exhaustion.take_drawn(1, false);
  exhaustion.take_drawn(2, false);
  exhaustion.take_drawn(3, true);  // by a spurious wake-up, say, which is not enumerated
  exhaustion.take_enumerated(1);
  EXPECT_FALSE(exhaustion.is_complete());
  exhaustion.take_enumerated(2);
  EXPECT_TRUE(exhaustion.is_complete());
}

// Two tasks, which store to so many variables that they have in common.
ExploreReport explored(std::size_t variables, std::uint64_t iterations = 10'000) {
  return explore(
      [=] {
        std::array<atomic<int>, 9> all;
        const auto store = [&] {
          for (std::size_t i = 0; i < variables; ++i) all[i].store(1);
        };
        thread one(store), two(store);
        one.join();
        two.join();
      },
      {.iterations = iterations});
}

TEST(Exhaustion, EndsACampaignThatHasTriedAll) {
  const ExploreReport report = explored(3);
  EXPECT_TRUE(report.passed) << report;
  EXPECT_TRUE(report.complete);
  EXPECT_LT(report.schedules, 600U);
  EXPECT_EQ(report.distinct, 8U);  // two orders at each variable
  EXPECT_EQ(report.scope,
            "exhausted, no other ordering exists up to the order of independent events, if there are no data races");
}

TEST(Exhaustion, IsNotSaidOfACampaignThatWasCutOff) {
  for (const std::uint64_t iterations : {230, 1000}) {
    const ExploreReport report = explored(9, iterations);
    EXPECT_EQ(report.schedules, iterations + 1);
    EXPECT_EQ(report.scope, "");
    EXPECT_FALSE(report.complete);
  }
}

// It fails in one of many orders only, which no draw is likely to be.
TEST(Exhaustion, FindsWhatDrawsDoNot) {
  const ExploreReport report = explore(alternate, {.strategy = "pct:1"});
  ASSERT_FALSE(report.passed);
  EXPECT_TRUE(contains(report.text, " of strategy dpor, seed 1 failed: ")) << report.text;
  const ExploreReport again = explore(alternate, {.replay = "wx1.2" + report.replay.substr(5)});
  EXPECT_TRUE(contains(again.text, "they have alternated")) << again.text;
}

// The tasks share a variable that the explorer does not know.
TEST(Exhaustion, TriesAllOrdersWhereEventsThatSeemIndependentAreNot) {
  const ExploreReport report = explore([] {
    int plain = 0;
    atomic<int> one(0), two(0), three(0);
    thread writer([&] {
      one.store(1);
      plain = 1;
    });
    two.store(1);
    if (plain == 1) three.store(1);
    writer.join();
  });
  EXPECT_TRUE(report.passed) << report;
  EXPECT_EQ(report.distinct, 2U);
  EXPECT_EQ(report.scope, "exhausted, no other ordering exists");
}

}  // namespace
}  // namespace waitpoint
