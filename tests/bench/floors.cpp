// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/floors.hpp"

#include <fmt/format.h>

namespace waitpoint::bench {

scenario::Scenario side_by_side(const scenario::Scenario& floor, int floors) {
  constexpr double side_m = 60;
  constexpr int floors_in_a_row = 10;
  scenario::Scenario all = floor;
  all.shapes.clear();
  all.shapes_written.clear();
  all.robots.clear();
  for (int i = 0; i < floors; ++i) {
    const double x_m = side_m * (i % floors_in_a_row), y_m = side_m * static_cast<double>(i / floors_in_a_row);
    for (world::Obstacle obstacle : floor.shapes) {
      obstacle.shape.pose.x += x_m;
      obstacle.shape.pose.y += y_m;
      all.shapes.push_back(std::move(obstacle));
    }
    all.shapes_written.insert(all.shapes_written.end(), floor.shapes_written.begin(), floor.shapes_written.end());
    for (scenario::RobotScenario robot : floor.robots) {
      robot.name += fmt::format("{}", i);
      robot.body.name = robot.name;
      robot.body.start.x += x_m;
      robot.body.start.y += y_m;
      for (scenario::Goal& goal : robot.goals) {
        goal.position.x += x_m;
        goal.position.y += y_m;
      }
      all.robots.push_back(std::move(robot));
    }
  }
  all.name = fmt::format("{}, {} floors", floor.name, floors);
  return all;
}

}  // namespace waitpoint::bench
