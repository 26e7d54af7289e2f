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

/// The message about a scenario on this map; "" if it has none.
std::string complaint(const Scenario& scenario, const OccupancyGrid& map, bool has_edge = false) {
  try {
    check_on_map(
        scenario, [&](const RobotScenario&) -> const OccupancyGrid& { return map; }, has_edge);
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "";
}

/// Robot one starts at (1, 1) and has goals at (3, 1) and (1, 4); robot two starts at (3, 2) and has none.
OccupancyGrid floor(int width, int height) { return OccupancyGrid(width, height, 0.5, {0, 0, 0}, Cell::free); }

TEST_F(ScenarioChecks, AcceptStartsAndGoalsInFreeSpace) {
  EXPECT_EQ(complaint(scenario_, floor(8, 10)), "");
  EXPECT_EQ(complaint(scenario_, floor(8, 10), true), "");
}

TEST_F(ScenarioChecks, ReportAGoalInsideAnObstacleAtItsLine) {
  OccupancyGrid map = floor(8, 10);
  map[{2, 8}] = Cell::occupied;
  EXPECT_EQ(complaint(scenario_, map),
            file_.string() + ":36: goal 2 'shelf' of robot 'one' is inside an obstacle, expected a free place");
}

TEST_F(ScenarioChecks, ReportAGoalInUnknownSpaceAtItsLine) {
  OccupancyGrid map = floor(8, 10);
  map[{6, 2}] = Cell::unknown;
  EXPECT_EQ(complaint(scenario_, map),
            file_.string() + ":35: goal 1 of robot 'one' is in an unknown part of the map, expected a free place");
}

TEST_F(ScenarioChecks, ReportAGoalOutsideTheMapAtItsLine) {
  EXPECT_EQ(complaint(scenario_, floor(6, 10)),
            file_.string() +
                ":35: goal 1 of robot 'one' is outside the map, which lies between (0.00, 0.00) and "
                "(3.00, 5.00); expected a free place on it");
}

TEST_F(ScenarioChecks, ReportAGoalOfAnOptionByTheOption) {
  const Scenario scenario = read_scenario(file_, {"robots.0.goals=[[99,99]]"});
  EXPECT_EQ(complaint(scenario, floor(8, 10)),
            "--set robots.0.goals=[[99,99]]: goal 1 of robot 'one' is outside the map, which lies between (0.00, 0.00) "
            "and (4.00, 5.00); expected a free place on it");
}

TEST_F(ScenarioChecks, ReportAStartOutsideTheMapAtItsLine) {
  const OccupancyGrid turned(8, 10, 0.5, {9, 2, exact::pi / 2}, Cell::free);
  EXPECT_EQ(complaint(scenario_, turned),
            file_.string() +
                ":33: robot 'one' starts outside the map, which lies between (4.00, 2.00) and "
                "(9.00, 6.00); expected a free place on it");
}

TEST_F(ScenarioChecks, AcceptAnyStartOnTheMapWithoutGoals) {
  const Scenario scenario = read_scenario(file_, {"robots.1.start=[99,99]"});
  EXPECT_EQ(complaint(scenario, floor(8, 10)), "");
  EXPECT_EQ(complaint(scenario, floor(8, 10), true),
            "--set robots.1.start=[99,99]: robot 'two' starts outside the map, which lies between (0.00, 0.00) and "
            "(4.00, 5.00); expected a free place on it");
}

TEST_F(ScenarioChecks, ReportAStartInsideAShapeWithBothLines) {
  EXPECT_NO_THROW(check_starts(scenario_, {}));
  EXPECT_EQ(message_of<BadInput>([&] {
              check_starts(scenario_, {{"one", "wall", false}});
            }),
            file_.string() + ":33: robot 'one' starts inside 'wall' (" + file_.string() + ":8), expected a free place");
}

TEST_F(ScenarioChecks, ReportOverlappingStartsWithBothLines) {
  EXPECT_EQ(
      message_of<BadInput>([&] {
        check_starts(scenario_, {{"two", "one", true}});
      }),
      file_.string() + ":39: robot 'two' starts inside robot 'one' (" + file_.string() + ":33), expected a free place");
}

}  // namespace
}  // namespace waitpoint::scenario
