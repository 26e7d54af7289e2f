// SPDX-License-Identifier: BSD-3-Clause
// Checks of a scenario that need its world: they name the line of the scenario that is wrong.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "modules/scenario/scenario.hpp"
#include "world/kinematic/start_check.hpp"

namespace waitpoint::scenario {

/// What is at a point where a robot is to go.
enum class GoalPlace {
  free,             ///< whether it can be reached is another question
  inside_obstacle,  ///< something known is there
  outside_map,      ///< the map ends before
};

/// Throws BadInput at the first goal that is not free.
void check_goals(const Scenario& scenario, const std::function<GoalPlace(const RobotScenario&, Point)>& place);

/// Throws BadInput at the start of the robot that the first overlap names, telling also where the other one was
/// written.
void check_starts(const Scenario& scenario, const std::vector<world::StartOverlap>& overlaps);

/// Throws BadInput for what a dynamic world cannot begin with: the first overlap of what is loose, a robot that could
/// turn by half a turn in a step.
void check_dynamic(const Scenario& scenario, const std::vector<world::LooseOverlap>& overlaps);

}  // namespace waitpoint::scenario
