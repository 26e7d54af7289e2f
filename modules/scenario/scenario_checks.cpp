// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/scenario_checks.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

namespace waitpoint::scenario {
namespace {

/// The place of an obstacle in the input; obstacles of the map are at the map's line.
std::string place_of_obstacle(const Scenario& scenario, const std::string& name) {
  for (std::size_t i = 0; i < scenario.shapes.size(); ++i) {
    if (scenario.shapes[i].name == name) return " (" + scenario.shapes_written[i].text() + ")";
  }
  for (std::size_t i = 0; i < scenario.meshes.size(); ++i) {
    if (scenario.meshes[i].name == name) return " (" + scenario.meshes_written[i].text() + ")";
  }
  return scenario.map ? " (" + scenario.map->file.string() + ")" : "";
}

const RobotScenario* robot_named(const Scenario& scenario, const std::string& name) {
  for (const RobotScenario& robot : scenario.robots) {
    if (robot.name == name) return &robot;
  }
  return nullptr;
}

std::string goal_title(const RobotScenario& robot, std::size_t index) {
  const std::string& name = robot.goals[index].name;
  return "goal " + std::to_string(index + 1) + (name.empty() ? "" : " '" + name + "'") + " of robot '" + robot.name +
         "'";
}

/// "which lies between (0.00, 0.00) and (40.20, 30.20)", by the smallest upright box about the map.
std::string extent(const OccupancyGrid& map) {
  const double length_m = map.width() * map.resolution_m(), width_m = map.height() * map.resolution_m();
  Point low = transform(map.origin(), {0, 0}), high = low;
  for (const Point corner : {Point{length_m, 0}, Point{0, width_m}, Point{length_m, width_m}}) {
    const Point p = transform(map.origin(), corner);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  char text[160];
  std::snprintf(text, sizeof text, "which lies between (%.2f, %.2f) and (%.2f, %.2f)", low.x, low.y, high.x, high.y);
  return text;
}

void check_goal(const RobotScenario& robot, std::size_t index, const OccupancyGrid& map) {
  const Goal& goal = robot.goals[index];
  const std::optional<CellIndex> cell = map.cell_at(goal.position);
  if (!cell)
    throw goal.written.bad(goal_title(robot, index) + " is outside the map, " + extent(map) +
                           "; expected a free place on it");
  if (map[*cell] == Cell::occupied)
    throw goal.written.bad(goal_title(robot, index) + " is inside an obstacle, expected a free place");
  if (map[*cell] == Cell::unknown)
    throw goal.written.bad(goal_title(robot, index) + " is in an unknown part of the map, expected a free place");
}

}  // namespace

void check_on_map(const Scenario& scenario, const MapOf& map_of, bool has_edge) {
  for (const RobotScenario& robot : scenario.robots) {
    if (robot.goals.empty() && !has_edge) continue;
    const OccupancyGrid& map = map_of(robot);
    if (!map.cell_at(robot.body.start.position()))
      throw robot.start_written.bad("robot '" + robot.name + "' starts outside the map, " + extent(map) +
                                    "; expected a free place on it");
    for (std::size_t i = 0; i < robot.goals.size(); ++i) check_goal(robot, i, map);
  }
}

void check_starts(const Scenario& scenario, const std::vector<world::StartOverlap>& overlaps) {
  if (overlaps.empty()) return;
  const world::StartOverlap& overlap = overlaps.front();
  const RobotScenario* robot = robot_named(scenario, overlap.body);
  WAITPOINT_CHECK(robot != nullptr, "the world names a body that the scenario does not have");
  const RobotScenario* other = overlap.other_is_body ? robot_named(scenario, overlap.other) : nullptr;
  const std::string place =
      other != nullptr ? " (" + other->start_written.text() + ")" : place_of_obstacle(scenario, overlap.other);
  throw robot->start_written.bad("robot '" + robot->name + "' starts inside " + (other != nullptr ? "robot " : "") +
                                 "'" + overlap.other + "'" + place + ", expected a free place");
}

void check_dynamic(const Scenario& scenario, const std::vector<world::LooseOverlap>& overlaps) {
  if (!overlaps.empty()) {
    const world::LooseOverlap& first = overlaps.front();
    for (std::size_t i = 0; i < scenario.shapes.size(); ++i) {
      if (scenario.shapes[i].name != first.loose) continue;
      throw scenario.shapes_written[i].bad("'" + first.loose + "', which is loose, starts inside '" + first.other +
                                           "'" + place_of_obstacle(scenario, first.other) + ", expected a free place");
    }
  }
  for (const RobotScenario& robot : scenario.robots) {
    if (robot.body.base.w_max_rad_s * scenario.step.seconds() < exact::pi) continue;
    throw robot.written.bad("expected a shorter step_ms for engine bullet: robot '" + robot.name +
                            "' can turn by half a turn in a step of " + to_string(scenario.step) + " s");
  }
}

}  // namespace waitpoint::scenario
