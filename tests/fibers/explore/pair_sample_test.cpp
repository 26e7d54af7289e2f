// SPDX-License-Identifier: BSD-3-Clause
// How much a search has seen: the sample of its schedules, the pairs of events that they show, the chance of a new one.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "fibers/explore/explore.hpp"
#include "fibers/explore/search/pair_sample.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "fibers/explore/strategies/random.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

using exploration::NewPairChance;
using exploration::PairIncidence;
using exploration::ReadsFrom;
using exploration::SampledSchedules;

// A schedule with these pairs, by number.
void take(PairIncidence& incidence, const std::vector<std::uint64_t>& numbers) {
  std::vector<ReadsFrom> pairs;
  for (const std::uint64_t number : numbers) pairs.push_back({number, 0, number});
  incidence.take(pairs);
}

TEST(PairIncidence, EstimatesTheShareOfSchedulesWithAPairOfTheirOwn) {
  PairIncidence incidence;
  EXPECT_FALSE(incidence.chance());
  take(incidence, {1, 2, 2, 1});
  EXPECT_FALSE(incidence.chance());
  take(incidence, {1, 2, 3, 3, 4});  // 3 and 4 are its own
  take(incidence, {1, 2});
  take(incidence, {1, 5});
  take(incidence, {2, 5});  // the same as the one before, but for common ones: in two schedules
  const NewPairChance chance = *incidence.chance();
  EXPECT_EQ(chance.schedules, 5u);
  EXPECT_EQ(chance.pairs, 5u);
  EXPECT_DOUBLE_EQ(chance.estimate, 0.2);
  const double bound = chance.upper_bound;
  EXPECT_NEAR((0.2 - bound) * (0.2 - bound), 1.96 * 1.96 / 5 * (bound * (1 - bound) + 2 * (1 + 1) / 5.0), 1e-9);
  EXPECT_EQ(chance.lower_bound, 0);
}

TEST(PairIncidence, HasAWidthWhereEachPairIsInSeveralSchedules) {
  PairIncidence incidence;
  for (int i = 0; i < 100; ++i) take(incidence, {1, 2, 3});
  const NewPairChance chance = *incidence.chance();
  EXPECT_EQ(chance.estimate, 0);
  EXPECT_EQ(chance.lower_bound, 0);
  EXPECT_NEAR(chance.upper_bound, 0.052, 0.001);
}

TEST(SampledSchedules, ContainTheRandomTurnsOfThePortfolio) {
  const SampledSchedules sampled("portfolio");
  const auto strategy = exploration::make_strategy("portfolio");
  for (std::uint64_t number = 0; number < 120; ++number) {
    strategy->begin(number, exploration::Draws(1, "portfolio", number), {});
    const bool is_random = dynamic_cast<exploration::Random*>(&strategy->deciding()) != nullptr;
    EXPECT_EQ(sampled.contain(number), is_random) << number;
    (void)strategy->end();
  }
}

TEST(SampledSchedules, AreDrawnIndependently) {
  for (const char* strategy : {"random", "pos", "pct:3", "surw"}) EXPECT_TRUE(SampledSchedules(strategy).contain(24));
  for (const char* strategy : {"rff", "goexplore", "dfs", "dpor", "fifo"})
    for (std::uint64_t number = 0; number < 50; ++number)
      EXPECT_FALSE(SampledSchedules(strategy).contain(number)) << strategy;
}

// Threads that each act `times` times on one atomic.
void contend(int times) {
  atomic<int> value(0);
  std::vector<thread> threads;
  for (int i = 0; i < 3; ++i)
    threads.emplace_back([&value, times] {
      for (int k = 0; k < times; ++k) value.store(k), (void)value.load();
    });
  for (thread& one : threads) one.join();
}

std::string text_of(const ExploreReport& report) {
  std::ostringstream text;
  text << report;
  return text.str();
}

TEST(ChanceOfNews, IsReportedWhereNotAllSchedulesWereTried) {
  const ExploreReport report = explore([] { contend(20); }, {.iterations = 240});
  ASSERT_TRUE(report.passed) << report;
  ASSERT_TRUE(report.chance_of_news);
  EXPECT_EQ(report.chance_of_news->strategy, "random");
  EXPECT_EQ(report.chance_of_news->schedules, 20u);
  EXPECT_GE(report.chance_of_news->pairs, 10u);
  EXPECT_NE(text_of(report).find(" pairs of events in 20 schedules of random, a new one in the next with a chance of "),
            std::string::npos)
      << report;
}

TEST(ChanceOfNews, IsNotReportedWhereAllWere) {
  const ExploreReport report = explore([] { contend(1); });
  ASSERT_TRUE(report.passed) << report;
  EXPECT_FALSE(report.scope.empty());
  EXPECT_FALSE(report.chance_of_news);
  EXPECT_EQ(text_of(report).find("pairs of events"), std::string::npos) << report;
}

TEST(ChanceOfNews, IsUnknownOfStrategiesThatLearn) {
  const ExploreReport report = explore([] { contend(20); }, {.strategy = "rff", .iterations = 100});
  ASSERT_TRUE(report.passed) << report;
  EXPECT_FALSE(report.chance_of_news);
}

}  // namespace
}  // namespace waitpoint
