// SPDX-License-Identifier: BSD-3-Clause
// Every data race is found, in the default order and in others, without false reports. This file is not instrumented;
// the programs beside it are.
#include "fibers/explore/races/races.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <vector>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/simulation.hpp"
#include "tests/fibers/explore/races/programs.hpp"

namespace waitpoint::races {
namespace {

std::string text_of(const std::vector<Race>& races) {
  std::ostringstream text;
  for (const Race& race : races) text << race;
  return text.str();
}

class Programs : public testing::TestWithParam<Program> {};

TEST_P(Programs, RaceOrNotInEveryOrder) {
  const Program& program = GetParam();
  for (std::uint64_t seed = 0; seed <= 20; ++seed) {
    SimulationOptions options;
    if (seed != 0) options.order = kernel::Order::seeded;
    options.seed = seed;
    const Report report = simulate(program.body, options);
    ASSERT_TRUE(report.passed) << report;
    ASSERT_EQ(any_found(), program.races) << "with seed " << seed << "\n" << text_of(found());
  }
}

std::string name_of(const testing::TestParamInfo<Program>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Plain, Programs, testing::ValuesIn(plain_programs()), name_of);
INSTANTIATE_TEST_SUITE_P(Ordered, Programs, testing::ValuesIn(ordered_programs()), name_of);
INSTANTIATE_TEST_SUITE_P(Atomic, Programs, testing::ValuesIn(atomic_programs()), name_of);

TEST(Races, AreReportedAsTwoAccessesWithTheirCalls) {
  ASSERT_TRUE(simulate(write_planted).passed);
  const std::vector<Race> races = found();
  ASSERT_EQ(races.size(), 1u) << text_of(races);
  const Race& race = races.front();
  EXPECT_EQ(race.address, &planted);
  EXPECT_EQ(race.memory, "waitpoint::races::planted");
  EXPECT_EQ(race.first.task, "ada");
  EXPECT_EQ(race.first.number, 1u);
  EXPECT_EQ(race.second.task, "bob");
  EXPECT_EQ(race.second.number, 2u);
  for (const Access* access : {&race.first, &race.second}) {
    EXPECT_TRUE(access->writes);
    EXPECT_FALSE(access->atomic);
    EXPECT_EQ(access->size, 4u);
    ASSERT_FALSE(access->calls.empty());
    EXPECT_NE(access->calls.front().find("write_planted"), std::string::npos) << access->calls.front();
    EXPECT_NE(access->calls.front().find("plain_programs.cpp:"), std::string::npos) << access->calls.front();
  }
  EXPECT_NE(text_of(races).find("first: write of 4 bytes by task ada#1"), std::string::npos) << text_of(races);
}

TEST(Races, TwoLinesAtOneVariableAreOneRace) {
  (void)simulate(count_twice_without_lock);  // a read and a write on each side
  EXPECT_EQ(found().size(), 1u) << text_of(found());
}

TEST(Races, OnAStackNameItsTask) {
  ASSERT_TRUE(simulate(plain_programs().front().body).passed);
  ASSERT_EQ(found().size(), 1u);
  EXPECT_EQ(found().front().memory, "the stack of task main");
}

TEST(Races, AreForgottenInTheNextRun) {
  ASSERT_TRUE(simulate(write_planted).passed);
  EXPECT_TRUE(any_found());
  ASSERT_TRUE(simulate([] {}).passed);
  EXPECT_FALSE(any_found());
}

// --- switch points ---

ExploreReport explored(void (*body)(), std::uint64_t iterations) {
  ExploreOptions options;
  options.strategy = "random";
  options.iterations = iterations;
  options.races = Races::ignore;  // only their consequences
  return explore_with(nullptr, body, options);
}

TEST(MemoryAccesses, AreSwitchPoints) {
  const ExploreReport report = explored(count_twice_without_lock, 200);
  EXPECT_FALSE(report.passed);
  EXPECT_NE(report.text.find("an increment is lost"), std::string::npos) << report;
}

TEST(MemoryAccesses, FirstOnesAreSwitchPointsOnceTheirCodeIsKnown) {
  learn(true);
  const Report report = simulate(publish_in_two_steps);
  learn(false);
  EXPECT_TRUE(report.passed) << report;
  EXPECT_FALSE(explored(publish_in_two_steps, 200).passed);
  forget_learned();
}

TEST(MemoryAccesses, FirstOnesAreNoSwitchPointsInExhaustiveSearch) {
  const ExploreReport report = explore(share_late, {.strategy = "dpor"});
  EXPECT_TRUE(report.passed) << report;
  EXPECT_FALSE(report.complete);
  EXPECT_EQ(report.scope,
            "all schedules up to the order of independent events, if there are no data races, except switches at first "
            "accesses to memory that the default order does not share");
}

TEST(MemoryAccesses, DependOnNoAddress) {
  const Report first = simulate(two_heaps);
  std::vector<std::unique_ptr<char[]>> between;
  for (std::size_t i = 1; i < 50; ++i) between.push_back(std::make_unique<char[]>(8 * i));
  const Report second = simulate(two_heaps);
  EXPECT_EQ(first.digest.value(), second.digest.value());
  EXPECT_EQ(first.events, second.events);
}

TEST(MemoryAccesses, RecordingAHistoryAddsNoSwitchPointsAndNoRaces) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto run = [seed](bool records) {
      SimulationOptions options;
      options.order = kernel::Order::seeded;
      options.seed = seed;
      return simulate([records] { write_and_read(records); }, options);
    };
    const Report with = run(true);
    EXPECT_TRUE(with.passed) << with;
    EXPECT_FALSE(any_found()) << text_of(found());
    const Report without = run(false);
    EXPECT_EQ(with.events, without.events);
    EXPECT_EQ(with.digest.value(), without.digest.value());
  }
}

TEST(MemoryAccesses, SpinningYieldsToOtherTasks) {
  const Report report = simulate(wait_for_nobody);
  EXPECT_EQ(report.end, RunEnd::no_progress) << report;
}

}  // namespace
}  // namespace waitpoint::races
