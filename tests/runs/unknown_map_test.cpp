// SPDX-License-Identifier: BSD-3-Clause
// A robot that keeps the map that it sees, and plans on it in motion.
#include <gtest/gtest.h>

#include "tests/runs/shipped.hpp"

namespace waitpoint::runs {
namespace {

// To the library, whose nearer door is blocked by a crate that is on no map.
bridge::RunResult to_the_library(const std::string& executive) {
  const scenario::Scenario scenario = shipped(
      "office.yaml",
      {"robots.0.start=[7.6,25.6,-90]", "robots.0.goals=[[6.85,17]]", "robots.0.executive={" + executive + "}"});
  return runs::run(scenario, Duration(std::chrono::seconds(100)));
}

TEST(PlanningInMotion, TakesTheDetourBeforeTheRobotStandsInFrontOfTheObstacle) {
  const bridge::RunResult in_motion = to_the_library("replan_ms: 200"), when_blocked = to_the_library("");
  for (const bridge::RunResult* result : {&in_motion, &when_blocked}) {
    EXPECT_TRUE(result->robots[0].goals[0].reached());
    EXPECT_EQ(result->robots[0].collisions, 0u);
  }
  EXPECT_LT(in_motion.robots[0].distance_m, when_blocked.robots[0].distance_m);
  EXPECT_LT(in_motion.robots[0].goals[0].date + Duration(std::chrono::seconds(8)),
            when_blocked.robots[0].goals[0].date);
}

TEST(PlanningInMotion, IsRepeatable) {
  EXPECT_EQ(to_the_library("replan_ms: 200").digest.value(), to_the_library("replan_ms: 200").digest.value());
}

}  // namespace
}  // namespace waitpoint::runs
