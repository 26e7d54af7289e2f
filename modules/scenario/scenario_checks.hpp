// SPDX-License-Identifier: BSD-3-Clause
// Checks of a scenario against its world. Errors name the line of the scenario.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "modules/scenario/scenario.hpp"
#include "world/kinematic/start_check.hpp"

namespace waitpoint::scenario {

/// The map on which a robot plans its routes.
using MapOf = std::function<const OccupancyGrid&(const RobotScenario&)>;

/// Throws BadInput for the first goal that is not free, or start beyond the edge of the map. A robot without goals may
/// start anywhere, unless the world `has_edge`: a map of cells ends where its image does.
void check_on_map(const Scenario& scenario, const MapOf& map_of, bool has_edge);

/// Throws BadInput for the first overlap, at the robot's start, with the place of the other body or obstacle.
void check_starts(const Scenario& scenario, const std::vector<world::StartOverlap>& overlaps);

/// Throws BadInput for an invalid initial state of a dynamic world: an overlap of a loose obstacle, or a robot whose
/// maximum turn rate is half a turn or more per step.
void check_dynamic(const Scenario& scenario, const std::vector<world::LooseOverlap>& overlaps);

}  // namespace waitpoint::scenario
