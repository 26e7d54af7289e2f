// SPDX-License-Identifier: BSD-3-Clause
// Merges a map's occupied cells into fewer, larger boxes with exactly the same area.
#pragma once

#include <string>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "world/description.hpp"

namespace waitpoint::world {

/// A block of cells: columns x to x + width - 1, rows y to y + height - 1.
struct CellBlock {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Blocks that cover every occupied cell once and no other. Greedy: from each cell not yet covered, in row order, the
/// larger of the block grown first along the row and the block grown first along the column. BadInput, naming `file`,
/// for more than obstacle_count_max blocks.
std::vector<CellBlock> merged_occupied_cells(const OccupancyGrid& grid, const std::string& file = "the map");

/// The merged blocks as obstacles from z_low_m to z_high_m, named "<name> 0", "<name> 1", ...
std::vector<Obstacle> obstacles_of(const OccupancyGrid& grid, const std::string& name, double z_low_m, double z_high_m,
                                   const std::string& file = "the map");

}  // namespace waitpoint::world
