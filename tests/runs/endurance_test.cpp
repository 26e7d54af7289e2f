// SPDX-License-Identifier: BSD-3-Clause
// A long run needs no more memory than a short one. `./dev test --endurance` is the same for a day.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>

#include "tests/runs/shipped.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {
namespace {

using namespace std::chrono_literals;

std::size_t allocated_bytes() {
  const struct mallinfo2 heap = mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

/// The most that is allocated at the end of one of the next 60 seconds: the executives' echoes come and go.
std::size_t peak_of_a_minute(run::Experiment& experiment, Duration begin) {
  std::size_t peak = 0;
  for (Duration at = begin; at < begin + 60s; at += 1s) {
    experiment.run_before(Time() + at);
    peak = std::max(peak, allocated_bytes());
  }
  return peak;
}

// A round takes about a minute.
TEST(Endurance, TwentyRobotsReachAllGoalsInConstantMemory) {
  const scenario::Scenario scenario = shipped("office-20.yaml", {"world.engine=slice"});
  const std::vector<genom::ModuleType> types = tools::papers_modules();
  run::Experiment experiment(scenario, types, {usual_seed, kernel::Order::fifo, ""});
  const std::size_t early = peak_of_a_minute(experiment, 60s);
  const Digest beginning = experiment.simulation().digest();
  const std::size_t late = peak_of_a_minute(experiment, 240s);
  EXPECT_LT(late, early + std::size_t{256} * 1024);
  for (const bridge::RobotResult& robot : experiment.result().robots) {
    EXPECT_EQ(robot.collisions, 0u) << robot.name;
    EXPECT_GE(robot.goals_reached(), 12u) << robot.name;
    EXPECT_EQ(robot.goals_reached(), robot.goal_visits()) << robot.name << " lost a goal";
  }
  const bridge::RunResult again = run(shipped("office-20.yaml"), 119s);
  EXPECT_EQ(to_string(again.digest), to_string(beginning)) << "and another engine is the same run";
}

}  // namespace
}  // namespace waitpoint::runs
