// SPDX-License-Identifier: BSD-3-Clause
// Shapes drawn onto a grid of cells, so that a planner sees a world that was given as shapes.
#pragma once

#include <span>

#include "core/occupancy_grid.hpp"
#include "world/description.hpp"

namespace waitpoint::world {

/// Marks as occupied every cell whose interior a shape reaches into (by more than 1e-9 m, so that a shape that ends on
/// a cell's edge does not take the next cell too). Shapes outside the grid are left out.
void draw(std::span<const Shape> shapes, OccupancyGrid& grid);

/// Marks as occupied every cell that the mesh has a point in, or on the edge of, between these heights: a surface has
/// no inside, and one that runs between two rows of cells is in both.
void draw(const TriangleMesh& mesh, double z_low_m, double z_high_m, OccupancyGrid& grid);

}  // namespace waitpoint::world
