// SPDX-License-Identifier: BSD-3-Clause
// Checks of a scenario against its world. Errors name the line of the scenario.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "modules/scenario/scenario.hpp"
#include "world/kinematic/start_check.hpp"

namespace waitpoint::scenario {

/// The state of a goal's position.
enum class GoalPlace {
  free,             ///< not necessarily reachable
  inside_obstacle,  ///< occupied by a known obstacle
  outside_map,      ///< unknown or beyond the map's edge
};

/// Throws BadInput for the first goal that is not free.
void check_goals(const Scenario& scenario, const std::function<GoalPlace(const RobotScenario&, Point)>& place);

/// Throws BadInput for the first overlap, at the robot's start, with the place of the other body or obstacle.
void check_starts(const Scenario& scenario, const std::vector<world::StartOverlap>& overlaps);

/// Throws BadInput for an invalid initial state of a dynamic world: an overlap of a loose obstacle, or a robot whose
/// maximum turn rate is half a turn or more per step.
void check_dynamic(const Scenario& scenario, const std::vector<world::LooseOverlap>& overlaps);

}  // namespace waitpoint::scenario
