// SPDX-License-Identifier: BSD-3-Clause
// A whole robot on one processor: its tasks delay each other, latencies grow, and with the priorities of the shipped
// scenario tasks miss deadlines.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "fibers/kernel/watch.hpp"
#include "tests/runs/shipped.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {
namespace {

using namespace std::chrono_literals;

// Greatest latency of a task from the tick of its period to the end of its work; for tasks that miss no deadline.
struct ResponseTime : kernel::Watch {
  ResponseTime(std::string of, Duration its_period, Duration its_delay)
      : task(std::move(of)), period(its_period), delay(its_delay) {
    event = [](kernel::Watch& watch, const kernel::EventRecord& record) {
      auto& self = static_cast<ResponseTime&>(watch);
      if (record.operation != kernel::Operation::timer_wait || record.task->name != self.task) return;
      const Duration since_first = record.time.since_start() - self.delay;
      if (since_first < self.period) return;
      self.worst = std::max(self.worst, Duration::from_ns(since_first.ns() % self.period.ns()));
    };
  }
  std::string task;
  Duration period, delay;
  Duration worst;
};

const std::string modules = "robots.rackham.modules.";
const std::vector<std::string> own_processors = {
    modules + "rflex.processor=", modules + "sick.processor=", modules + "pom.processor=", modules + "ndd.processor=",
    modules + "segloc.processor="};
const std::vector<std::string> by_periods = {modules + "segloc.priority=10"};

bridge::RunResult run_with(const std::vector<std::string>& assignments, kernel::Order order = kernel::Order::fifo,
                           std::uint64_t seed = usual_seed) {
  return run(shipped("office-one-processor.yaml", assignments), Duration(15s), seed, order);
}

TEST(OneProcessor, TheTasksThatTheMostUrgentHoldsUpMissTheirDeadlines) {
  const bridge::RunResult result = run_with({});
  const std::vector<bridge::LateTask>& late = result.robots.at(0).late_tasks;
  ASSERT_EQ(late.size(), 3u);
  const char* names[] = {"rflex.motion", "sick.scanning", "pom.fusing"};
  for (std::size_t i = 0; i < late.size(); ++i) {
    EXPECT_EQ(late[i].name, names[i]);
    EXPECT_NEAR(static_cast<double>(late[i].missed_deadlines), i == 2 ? 70 : 145, 8) << "once a scan, every 100 ms";
    EXPECT_GT(late[i].greatest_lateness, Duration(10ms));
    EXPECT_LT(late[i].greatest_lateness, Duration(45ms)) << "60 ms of localising, and a period of 20 ms";
  }
  EXPECT_EQ(late[0].missed_periods, 2 * late[0].missed_deadlines) << "60 ms: the ticks at 40 and at 60 are missed";
}

TEST(OneProcessor, ByTheLengthsOfTheirPeriodsAllAreInTime) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    EXPECT_TRUE(run_with(by_periods, seed == 1 ? kernel::Order::fifo : kernel::Order::seeded, seed)
                    .robots.at(0)
                    .late_tasks.empty());
}

Duration worst_response(const std::string& task, Duration period, Duration delay,
                        const std::vector<std::string>& assignments) {
  const std::vector<genom::ModuleType> types = tools::papers_modules();
  const scenario::Scenario scenario = shipped("office-one-processor.yaml", assignments);
  run::Experiment experiment(scenario, types, {usual_seed, kernel::Order::fifo, ""});
  ResponseTime response(task, period, delay);
  kernel::set_watch(experiment.simulation().scheduler(), &response);
  experiment.run_before(Time() + Duration(10s));
  return response.worst;
}

// Other computation on the processor delays a task that still meets its deadlines.
TEST(OneProcessor, LatenciesGrow) {
  // 0.2 ms of its own and 2 ms for the route; on the shared processor also base and laser, which are more urgent.
  EXPECT_EQ(worst_response("ndd.motion", 100ms, 20ms, own_processors), Duration(2200us));
  EXPECT_EQ(worst_response("ndd.motion", 100ms, 20ms, by_periods), Duration(2800us));
  EXPECT_EQ(worst_response("segloc.slam", 100ms, 0ms, own_processors), Duration(60ms));
  const Duration shared = worst_response("segloc.slam", 100ms, 0ms, by_periods);
  EXPECT_GT(shared, Duration(63ms));
  EXPECT_LT(shared, Duration(67ms)) << "60 + 4 * (0.1 + 0.5) + 2 * 0.2 + 2.2";
}

// The executive's planning, too, takes time on the processor that the scenario names.
TEST(OneProcessor, TheExecutivesPlanningDelaysItsDrivingAndItsPriorityTheOthers) {
  const auto driven_m = [](const std::vector<std::string>& assignments) {
    return run(shipped("office-one-processor.yaml", assignments), Duration(4s)).robots.at(0).distance_m;
  };
  const std::string executive = "robots.rackham.executive.", low = modules + "segloc.priority=10";
  EXPECT_GT(driven_m({low}), 1);
  EXPECT_EQ(driven_m({low, executive + "plan_cost_us=5000000"}), 0);
  EXPECT_GT(driven_m({low, executive + "plan_cost_us=5000000", executive + "clock={scale: x0.01}"}), 1);
  const auto late = [&](const std::string& priority) {
    return run_with({low, executive + "plan_cost_us=200000", executive + "processor=cpu", executive + priority})
        .robots.at(0)
        .late_tasks.size();
  };
  EXPECT_EQ(late("priority=1"), 0u);
  EXPECT_EQ(late("priority=99"), 5u);
  try {
    run_with({executive + "processor=gpu"});
    ADD_FAILURE() << "the robot has no such processor";
  } catch (const BadInput& error) {
    EXPECT_STREQ(error.what(),
                 "--set robots.rackham.executive.processor=gpu: expected 'processor' to be one of this robot's "
                 "processors, found 'gpu'");
  }
}

TEST(OneProcessor, IsTheCauseOfItAll) { EXPECT_TRUE(run_with(own_processors).robots.at(0).late_tasks.empty()); }

TEST(OneProcessor, MissedDeadlinesFollowTheComputingTimesThatTheChooserTook) {
  const auto lateness = [](std::uint64_t seed) {
    return run_with({}, kernel::Order::seeded, seed).robots.at(0).late_tasks.at(0).greatest_lateness;
  };
  EXPECT_NE(lateness(1), lateness(2));
  EXPECT_LE(lateness(1), run_with({}).robots.at(0).late_tasks.at(0).greatest_lateness + Duration(1ms));
  const bridge::RunResult first = run_with({}, kernel::Order::seeded, 3),
                          again = run_with({}, kernel::Order::seeded, 3);
  EXPECT_EQ(first.digest, again.digest);
}

}  // namespace
}  // namespace waitpoint::runs
