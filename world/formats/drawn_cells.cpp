// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/drawn_cells.hpp"

#include <algorithm>
#include <cmath>

#include "world/planar/separation.hpp"

namespace waitpoint::world {
namespace {

constexpr double edge_m = 1e-9;

// The cell that holds the coordinate, or the nearest one of the grid.
int clamped_cell(double coordinate_m, double cell_m, int count) {
  return static_cast<int>(std::clamp(std::floor(coordinate_m / cell_m), 0.0, static_cast<double>(count - 1)));
}

}  // namespace

void draw(std::span<const Shape> shapes, OccupancyGrid& grid) {
  const double cell = grid.resolution_m();
  Outline square;
  square.is_box = true;
  square.half_length_m = square.half_width_m = 0.5 * cell;
  for (const Shape& shape : shapes) {
    // In the grid's own frame its cells are axis-parallel.
    Shape inside = shape;
    inside.pose = between(grid.origin(), shape.pose);
    const Outline outline = outline_of(inside);
    const Bounds bounds = bounds_of(outline);
    const int x_end = clamped_cell(bounds.high.x, cell, grid.width());
    const int y_end = clamped_cell(bounds.high.y, cell, grid.height());
    for (int y = clamped_cell(bounds.low.y, cell, grid.height()); y <= y_end; ++y) {
      for (int x = clamped_cell(bounds.low.x, cell, grid.width()); x <= x_end; ++x) {
        square.centre = {(x + 0.5) * cell, (y + 0.5) * cell};
        if (separation(square, outline).distance_m < -edge_m) grid[{x, y}] = Cell::occupied;
      }
    }
  }
}

}  // namespace waitpoint::world
