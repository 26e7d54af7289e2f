// SPDX-License-Identifier: BSD-3-Clause
// Rasterises shapes onto an occupancy grid, for planners in a world given as shapes.
#pragma once

#include <span>

#include "core/occupancy_grid.hpp"
#include "world/description.hpp"

namespace waitpoint::world {

/// Marks as occupied every cell whose interior overlaps a shape, by more than 1e-9 m, so that a shape that ends on a
/// cell's edge does not mark the next cell. Shapes outside the grid are ignored.
void draw(std::span<const Shape> shapes, OccupancyGrid& grid);

/// Marks as occupied every cell with a point of the mesh between these heights in it or on its edge: a surface has no
/// interior, and one exactly between two rows of cells is in both.
void draw(const TriangleMesh& mesh, double z_low_m, double z_high_m, OccupancyGrid& grid);

}  // namespace waitpoint::world
