// SPDX-License-Identifier: BSD-3-Clause
// One seed gives one run: the first seconds of the office, repeated in one process.
#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "core/random.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/watch.hpp"
#include "tests/project.hpp"
#include "tests/runs/shipped.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {
namespace {

using namespace std::chrono_literals;

TEST(Repetition, HundredRunsInOneProcessAreEqual) {
  const scenario::Scenario scenario = shipped("office.yaml");
  const bridge::RunResult first = run(scenario);
  ASSERT_GT(first.events, 10'000u);
  ASSERT_GT(first.robots.at(0).distance_m, 5);
  std::vector<std::unique_ptr<char[]>> ballast;  // shifts the allocations of later runs
  for (int repeat = 1; repeat <= 100; ++repeat) {
    ballast.push_back(std::make_unique<char[]>(static_cast<std::size_t>(repeat) * 97));
    const bridge::RunResult again = run(scenario);
    ASSERT_EQ(to_string(again.digest), to_string(first.digest)) << "repeat " << repeat;
    ASSERT_EQ(again.events, first.events);
  }
}

TEST(Repetition, SeededOrderRepeatsAndDiffersFromFifo) {
  const scenario::Scenario scenario = shipped("office.yaml");
  const auto seeded = [&](std::uint64_t seed) {
    return to_string(run(scenario, first_seconds, seed, kernel::Order::seeded).digest);
  };
  const std::string first = seeded(usual_seed);
  EXPECT_NE(first, to_string(run(scenario).digest));
  for (int repeat = 0; repeat < 5; ++repeat) EXPECT_EQ(seeded(usual_seed), first);
  EXPECT_NE(seeded(usual_seed + 1), first);
}

TEST(Repetition, RunsInSeveralThreadsEqualSingleRuns) {
  if (test::is_emulated()) GTEST_SKIP() << "eight runs at once need more address space than qemu has";
  const scenario::Scenario scenario = shipped("office.yaml");
  const auto digest = [&](std::size_t seed) { return to_string(run(scenario, 5s, seed).digest); };
  for (const std::size_t threads : {2, 8}) {
    std::vector<std::string> together(threads);
    {
      std::vector<std::jthread> running;
      for (std::size_t i = 0; i < threads; ++i) running.emplace_back([&, i] { together[i] = digest(i); });
    }
    for (std::size_t i = 0; i < threads; ++i) EXPECT_EQ(together[i], digest(i)) << threads << " threads, seed " << i;
  }
}

TEST(Repetition, EverySeedGivesAnotherDigest) {
  const scenario::Scenario scenario = shipped("office.yaml");
  std::set<std::string> digests;
  for (std::uint64_t seed = 0; seed < 20; ++seed) digests.insert(to_string(run(scenario, 2s, seed).digest));
  EXPECT_EQ(digests.size(), 20u);
}

TEST(Repetition, WindowsDoNotChangeTheRun) {
  const scenario::Scenario scenario = shipped("office.yaml");
  const std::vector<genom::ModuleType> types = tools::papers_modules();
  const std::string whole = to_string(run(scenario).digest);
  const auto in_windows = [&](auto width_of) {
    run::Experiment experiment(scenario, types, {usual_seed, kernel::Order::fifo, ""});
    Time until;
    for (std::uint64_t window = 0; until < Time() + first_seconds; ++window) {
      until = std::min(until + Duration(width_of(window)), Time() + first_seconds);
      experiment.run_before(until);
    }
    return to_string(experiment.result().digest);
  };
  for (const Duration width : {Duration(7s), Duration(100ms), Duration(10ms), Duration(3333us), Duration(500us)})
    EXPECT_EQ(in_windows([&](std::uint64_t) { return width; }), whole) << to_string(width) << " s";
  const RandomStream random(1, "test", "windows");
  const auto any = [&](std::uint64_t window) { return std::chrono::nanoseconds(1 + random.below(30'000'000, window)); };
  EXPECT_EQ(in_windows(any), whole);
}

TEST(Repetition, ObserversDoNotChangeTheRun) {
  const scenario::Scenario scenario = shipped("office.yaml");
  const std::vector<genom::ModuleType> types = tools::papers_modules();
  run::Experiment experiment(scenario, types, {usual_seed, kernel::Order::fifo, ""});
  struct Counter : kernel::Watch {
    std::uint64_t events = 0;
  } counter;
  counter.event = [](kernel::Watch& watch, const kernel::EventRecord&) { ++static_cast<Counter&>(watch).events; };
  kernel::set_watch(experiment.simulation().scheduler(), &counter);
  std::size_t segments = 0;
  for (Time until; until < Time() + first_seconds; until += 100ms) {
    experiment.run_before(until + 100ms);
    segments += experiment.result().robots.at(0).segments.size();
    const world::BodyState& body = experiment.world().body(world::BodyId(0));
    segments += experiment.world().cast({body.pose.position(), body.pose.heading, 0.4}, 30) < 30 ? 1 : 0;
  }
  EXPECT_GT(segments, 0u);
  EXPECT_EQ(counter.events, experiment.result().events);
  EXPECT_EQ(to_string(experiment.result().digest), to_string(run(scenario).digest));
}

}  // namespace
}  // namespace waitpoint::runs
