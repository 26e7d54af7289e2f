// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/scenario_checks.hpp"

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

}  // namespace

void check_goals(const Scenario& scenario, const std::function<GoalPlace(const RobotScenario&, Point)>& place) {
  for (const RobotScenario& robot : scenario.robots) {
    for (std::size_t i = 0; i < robot.goals.size(); ++i) {
      const Goal& goal = robot.goals[i];
      switch (place(robot, goal.position)) {
        case GoalPlace::free: break;
        case GoalPlace::inside_obstacle:
          throw goal.written.bad(goal_title(robot, i) + " is inside an obstacle, expected a free place");
        case GoalPlace::outside_map:
          throw goal.written.bad(goal_title(robot, i) + " is outside the map, expected a free place on it");
      }
    }
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
