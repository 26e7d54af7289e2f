// SPDX-License-Identifier: BSD-3-Clause
// All levels on threads of either kind: a plan, a script below it, execution control, and the five modules. A loaded
// machine may be late: the test requires that the plan is completed, at any time.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "modules/run/threaded_experiment.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tests/modules/on_threads.hpp"
#include "tests/project.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::tcl {
namespace {

using namespace std::chrono_literals;

// The shipped scenario, with a shorter plan.
scenario::Scenario levels() {
  const std::filesystem::path plan =
      std::filesystem::path(testing::TempDir()) / ("waitpoint_levels_" + std::to_string(getpid()) + ".yaml");
  std::ofstream(plan) << R"(
format: 1
name: short
ready: [{poster: pom.position}, {poster: sick.echoes}]
actions:
  - {name: go, kind: contingent, duration_s: [0.1, 60], tcl: visit 20 4.6}
  - {name: picture, duration_s: [0.2, 60], request: sick.SegmentsOn, stop: sick.SegmentsOff, after: go}
done: [tcl: halt]
)";
  return scenario::read_scenario(test::project_root() / "scenarios" / "laas.yaml", {"robots.0.plan=" + plan.string()});
}

TEST(Levels, CompleteThePlanOnThreads) {
  const scenario::Scenario scenario = levels();
  on_threads([&] {
    run::ThreadedExperiment experiment(scenario, tools::papers_modules(), 1);
    experiment.run_for(100s);
    const bridge::RunResult result = experiment.result();
    EXPECT_EQ(result.outcome, bridge::Outcome::finished);
    const bridge::RobotResult& robot = result.robots.at(0);
    EXPECT_TRUE(robot.plan->completed) << robot.plan->end;
    EXPECT_GT(robot.distance_m, 0.3);
  });
}

TEST(Levels, StopWhenTheTimeIsUp) {
  const scenario::Scenario scenario = levels();
  on_threads([&] {
    run::ThreadedExperiment experiment(scenario, tools::papers_modules(), 1);
    experiment.run_for(800ms);
    const bridge::RunResult result = experiment.result();
    EXPECT_EQ(result.outcome, bridge::Outcome::time_limit);
    EXPECT_FALSE(result.robots.at(0).plan->completed);
  });
}

}  // namespace
}  // namespace waitpoint::tcl
