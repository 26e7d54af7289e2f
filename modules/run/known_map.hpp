// SPDX-License-Identifier: BSD-3-Clause
// The map that a robot's planner is given: what a scenario's world shows of itself, as a grid of cells.
#pragma once

#include "core/occupancy_grid.hpp"
#include "modules/scenario/scenario.hpp"
#include "world/formats/world_file.hpp"

namespace waitpoint::run {

/// Edge of a cell where the world is drawn by shapes alone.
inline constexpr double drawn_resolution_m = 0.05;

/// Room around starts and goals where a map file has no cells that say where its floor ends.
inline constexpr double drawn_margin_m = 2;

/// The cells of the map file, if it is one of cells, with what is known drawn onto them; else a free grid that just
/// holds all shapes, and with a map file of shapes also every start and goal, with a margin. `map` is what the map file
/// says, null if there is none. What ends below the robot, where it starts, or begins above it is not in its way and
/// not drawn.
OccupancyGrid known_map(const scenario::Scenario& scenario, const world::WorldFile* map,
                        const scenario::RobotScenario& robot);

}  // namespace waitpoint::run
