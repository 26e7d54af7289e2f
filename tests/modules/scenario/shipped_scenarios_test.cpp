// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "modules/scenario/scenario_reader.hpp"
#include "tests/project.hpp"
#include "world/kinematic/start_check.hpp"
#include "world/planar/separation.hpp"

namespace waitpoint::scenario {
namespace {

Scenario shipped(const std::string& name, const std::vector<std::string>& assignments = {}) {
  return read_scenario(test::project_root() / "scenarios" / name, assignments);
}

/// The distance from the point to the nearest shape.
double clearance_m(const Scenario& scenario, Point p) {
  world::Outline point;
  point.centre = p;
  double least_m = 100;
  for (const world::Obstacle& obstacle : scenario.shapes) {
    least_m = std::min(least_m, world::separation(world::outline_of(obstacle.shape), point).distance_m);
  }
  return least_m;
}

class ShippedScenario : public ::testing::TestWithParam<std::string> {};

TEST_P(ShippedScenario, HasFreeStartsAndGoals) {
  const Scenario scenario = shipped(GetParam());
  EXPECT_TRUE(scenario.expect.all_goals_reached);
  EXPECT_EQ(scenario.expect.collisions, 0u);
  EXPECT_TRUE(world::start_overlaps(scenario.world_without_map()).empty());
  for (const RobotScenario& robot : scenario.robots) {
    EXPECT_GE(robot.goals.size(), 4u) << robot.name;
    for (const Goal& goal : robot.goals) EXPECT_GE(clearance_m(scenario, goal.position), 0.6) << goal.written.text();
  }
}

INSTANTIATE_TEST_SUITE_P(Scenario, ShippedScenario,
                         ::testing::Values("office.yaml", "office-10.yaml", "office-20.yaml",
                                           "office-one-processor.yaml", "office-measured.yaml", "yard.yaml"),
                         [](const auto& info) {
                           std::string name = info.param.substr(0, info.param.find('.'));
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(ShippedScenario, OfficeHasOneRobotSixGoalsAndAnUnmappedCrate) {
  const Scenario scenario = shipped("office.yaml");
  ASSERT_EQ(scenario.robots.size(), 1u);
  EXPECT_GE(scenario.robots[0].goals.size(), 6u);
  EXPECT_EQ(scenario.robots[0].body.sensors<world::Lasers>().at(0).beams, 361u);
  std::size_t unknown = 0;
  for (const world::Obstacle& obstacle : scenario.shapes) unknown += obstacle.known ? 0 : 1;
  EXPECT_EQ(unknown, 1u);
}

TEST(ShippedScenario, Office10HasTenRobotsOfDifferentNames) { EXPECT_EQ(shipped("office-10.yaml").robots.size(), 10u); }

TEST(ShippedScenario, SetDisablesAModuleOfTheType) {
  const Scenario scenario = shipped("office.yaml", {"robot_types.rackham.modules.segloc.enabled=false"});
  for (const ModuleScenario& module : scenario.robots.at(0).modules) {
    EXPECT_EQ(module.enabled, module.name != "segloc" && module.name != "locate") << module.name;
  }
}

TEST(ShippedScenario, SetReplacesTheFloorByAMap) {
  const Scenario scenario = shipped(
      "office.yaml", {"world.map.file=m.yaml", "world.shapes=[]", "robots.0.start=[1,2]", "robots.0.goals=[[3,4]]"});
  EXPECT_TRUE(scenario.shapes.empty());
  EXPECT_EQ(scenario.map->file, "m.yaml");
  EXPECT_EQ(scenario.robots[0].body.start, (Pose{1, 2, 0}));
}

}  // namespace
}  // namespace waitpoint::scenario
