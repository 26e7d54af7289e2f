// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/scenario_checks.hpp"

#include <gtest/gtest.h>

#include "modules/scenario/scenario_reader.hpp"
#include "tests/modules/scenario/scenario_text.hpp"

namespace waitpoint::scenario {
namespace {

class ScenarioChecks : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.write("s.yaml", valid_scenario);
  Scenario scenario_ = read_scenario(file_);
};

TEST_F(ScenarioChecks, goals_in_free_places_pass) {
  EXPECT_NO_THROW(check_goals(scenario_, [](const RobotScenario&, Point) { return GoalPlace::free; }));
}

TEST_F(ScenarioChecks, a_goal_inside_an_obstacle_is_told_at_its_line) {
  const auto place = [](const RobotScenario&, Point p) {
    return p.y == 4 ? GoalPlace::inside_obstacle : GoalPlace::free;
  };
  EXPECT_EQ(message_of<BadInput>([&] { check_goals(scenario_, place); }),
            file_.string() + ":36: goal 2 'shelf' of robot 'one' is inside an obstacle, expected a free place");
}

TEST_F(ScenarioChecks, a_goal_outside_the_map_is_told_at_its_line) {
  const auto place = [](const RobotScenario&, Point) { return GoalPlace::outside_map; };
  EXPECT_EQ(message_of<BadInput>([&] { check_goals(scenario_, place); }),
            file_.string() + ":35: goal 1 of robot 'one' is outside the map, expected a free place on it");
}

TEST_F(ScenarioChecks, a_goal_of_an_option_is_told_by_the_option) {
  const Scenario scenario = read_scenario(file_, {"robots.0.goals=[[99,99]]"});
  const auto place = [](const RobotScenario&, Point) { return GoalPlace::outside_map; };
  EXPECT_EQ(message_of<BadInput>([&] { check_goals(scenario, place); }),
            "--set robots.0.goals=[[99,99]]: goal 1 of robot 'one' is outside the map, expected a free place on it");
}

TEST_F(ScenarioChecks, a_robot_that_starts_inside_a_shape_is_told_with_both_lines) {
  EXPECT_NO_THROW(check_starts(scenario_, {}));
  EXPECT_EQ(message_of<BadInput>([&] {
              check_starts(scenario_, {{"one", "wall", false}});
            }),
            file_.string() + ":33: robot 'one' starts inside 'wall' (" + file_.string() + ":8), expected a free place");
}

TEST_F(ScenarioChecks, a_robot_that_starts_inside_another_is_told_with_both_lines) {
  EXPECT_EQ(
      message_of<BadInput>([&] {
        check_starts(scenario_, {{"two", "one", true}});
      }),
      file_.string() + ":39: robot 'two' starts inside robot 'one' (" + file_.string() + ":33), expected a free place");
}

}  // namespace
}  // namespace waitpoint::scenario
