// SPDX-License-Identifier: BSD-3-Clause
// The scenario chooses the world's step; a coarse one gives a warning, and the goals are still reached.
#include <gtest/gtest.h>

#include "tests/runs/shipped.hpp"

namespace waitpoint::runs {
namespace {

TEST(WorldStep, TheOfficesGoalsAreReachedAtACoarseStepTooAndItIsTold) {
  for (const std::string step_ms : {"40", "100"}) {
    const scenario::Scenario scenario = shipped("office.yaml", {"world.step_ms=" + step_ms});
    const bridge::RunResult result = run(scenario, scenario.until);
    EXPECT_EQ(result.warnings,
              std::vector<std::string>{"the world's step of " + to_string(scenario.step) +
                                       " s exceeds the least period of rackham's software, 0.020000000 s"});
    EXPECT_EQ(result.robots[0].collisions, 0u);
    for (const bridge::GoalResult& goal : result.robots[0].goals) EXPECT_TRUE(goal.reached()) << goal.report;
  }
}

TEST(WorldStep, NothingIsToldOfAStepThatTheSoftwareDoesNotNotice) {
  EXPECT_TRUE(run(shipped("office.yaml", {"world.step_ms=20"}), Duration(std::chrono::seconds(1))).warnings.empty());
}

TEST(WorldStep, OneLineTellsItOfAllRobots) {
  const bridge::RunResult result = run(shipped("office-10.yaml", {"world.step_ms=50",
                                                                  "robots.hugo.modules=[{name: rflex, tasks: {motion: "
                                                                  "{period_ms: 10}}}]"}),
                                       Duration(std::chrono::milliseconds(100)));
  EXPECT_EQ(result.warnings,
            std::vector<std::string>{"the world's step of 0.050000000 s exceeds the least period of hugo's software, "
                                     "0.010000000 s, and of 9 other robots"});
}

}  // namespace
}  // namespace waitpoint::runs
