// SPDX-License-Identifier: BSD-3-Clause
// The a-priori map of a robot's planner: the known part of the scenario's world, as a grid of cells.
#pragma once

#include "core/occupancy_grid.hpp"
#include "modules/scenario/scenario.hpp"
#include "world/formats/world_file.hpp"

namespace waitpoint::run {

/// Cell size of a map made from shapes alone.
inline constexpr double drawn_resolution_m = 0.05;

/// Margin around starts and goals if no map file with cells bounds the floor.
inline constexpr double drawn_margin_m = 2;

/// A map of all shapes that would be too large ends at this distance from the starts and goals.
inline constexpr double drawn_reach_m = 100;

/// With a map file of cells: these cells, with the known shapes drawn onto them. Otherwise a free grid that encloses
/// all shapes and, with a map file of shapes, every start and goal with a margin. `map` is the content of the map file,
/// null without one. Shapes entirely below the robot's start height or above its top are not drawn.
OccupancyGrid known_map(const scenario::Scenario& scenario, const world::WorldFile* map,
                        const scenario::RobotScenario& robot);

/// The number of obstacles that lie entirely beyond a map that was drawn.
std::size_t obstacles_beyond(const OccupancyGrid& map, const scenario::Scenario& scenario,
                             const world::WorldFile* file);

}  // namespace waitpoint::run
