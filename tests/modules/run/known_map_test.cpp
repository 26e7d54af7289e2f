// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/known_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace waitpoint::run {
namespace {

world::Obstacle box(Point centre, double length_m, double width_m) {
  world::Obstacle obstacle;
  obstacle.shape.pose = {centre.x, centre.y, 0};
  obstacle.shape.length_m = length_m;
  obstacle.shape.width_m = width_m;
  return obstacle;
}

scenario::Scenario with_robot(Point start, std::vector<Point> goals) {
  scenario::Scenario scenario;
  scenario.robots.emplace_back();
  scenario.robots.front().body.start = {start.x, start.y, 0};
  for (const Point goal : goals) scenario.robots.front().goals.push_back({goal, "", {}});
  return scenario;
}

bool has_occupied(const OccupancyGrid& map) {
  return std::find(map.cells().begin(), map.cells().end(), Cell::occupied) != map.cells().end();
}

TEST(KnownMap, AnEmptyWorldIsAFieldAboutStartsAndGoals) {
  const scenario::Scenario scenario = with_robot({1, 1}, {{8, 3}});
  const OccupancyGrid map = known_map(scenario, nullptr, scenario.robots.front());
  for (const Point inside : {Point{-0.9, -0.9}, Point{9.9, 4.9}}) EXPECT_TRUE(map.cell_at(inside).has_value());
  EXPECT_FALSE(map.cell_at({10.2, 3}).has_value());
}

TEST(KnownMap, AGoalOutsideTheShapesHasAMargin) {
  scenario::Scenario scenario = with_robot({1, 1}, {{8, 3}});
  scenario.shapes.push_back(box({2, 2}, 4, 4));
  const OccupancyGrid map = known_map(scenario, nullptr, scenario.robots.front());
  EXPECT_TRUE(map.cell_at({9.9, 3}).has_value());
  EXPECT_FALSE(map.cell_at({-0.1, 2}).has_value());  // the start is inside: its margin is the shapes' extent
}

TEST(KnownMap, AnObjectFarFromEveryRobotIsNotOnIt) {
  scenario::Scenario scenario = with_robot({1, 1}, {{8, 3}});
  scenario.shapes.push_back(box({2, 2}, 4, 4));
  scenario.shapes.push_back(box({25000, 26000}, 1, 1));
  const OccupancyGrid map = known_map(scenario, nullptr, scenario.robots.front());
  EXPECT_TRUE(map.cell_at({1, 1}).has_value());
  EXPECT_TRUE(map.cell_at({100, 100}).has_value()) << "within reach of the goal";
  EXPECT_FALSE(map.cell_at({150, 1}).has_value());
  EXPECT_EQ(obstacles_beyond(map, scenario, nullptr), 1u);
}

TEST(KnownMap, UnknownMapGivesItsExtentOnly) {
  world::WorldFile file;
  file.obstacles.push_back(box({5, 5}, 10, 10));
  file.obstacles.front().shape.z_high_m = 1;
  scenario::Scenario scenario = with_robot({-3, 5}, {{13, 5}});
  scenario.map.emplace();
  EXPECT_TRUE(has_occupied(known_map(scenario, &file, scenario.robots.front())));
  scenario.map->known = false;
  const OccupancyGrid map = known_map(scenario, &file, scenario.robots.front());
  EXPECT_FALSE(has_occupied(map));
  EXPECT_TRUE(map.cell_at({5, 9.9}).has_value());
}

}  // namespace
}  // namespace waitpoint::run
