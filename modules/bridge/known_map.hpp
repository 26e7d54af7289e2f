// SPDX-License-Identifier: BSD-3-Clause
// The map that planners are given: what a scenario's world shows of itself, as a grid of cells.
#pragma once

#include "core/occupancy_grid.hpp"
#include "modules/bridge/scenario.hpp"

namespace waitpoint::bridge {

/// Edge of a cell where the world is drawn by shapes alone.
inline constexpr double drawn_resolution_m = 0.05;

/// The scenario's map with the known shapes drawn onto it; without a map, a free grid that just holds all shapes. `map`
/// is what the map file says, if there is one.
OccupancyGrid known_map(const Scenario& scenario, const OccupancyGrid* map);

}  // namespace waitpoint::bridge
