// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/drawn_cells.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "world/mesh/section.hpp"
#include "world/planar/separation.hpp"

namespace waitpoint::world {
namespace {

constexpr double edge_m = 1e-9;

// The index of the cell at the coordinate, clamped to the grid.
int clamped_cell(double coordinate_m, double cell_m, int count) {
  return static_cast<int>(std::clamp(std::floor(coordinate_m / cell_m), 0.0, static_cast<double>(count - 1)));
}

/// Marks the cells that the outline overlaps by more than `depth_m`. The outline is in the grid's frame, where cells
/// are axis-parallel.
void draw_in_frame(const Outline& outline, double depth_m, OccupancyGrid& grid) {
  const double cell = grid.resolution_m();
  Outline square;
  square.is_box = true;
  square.half_length_m = square.half_width_m = 0.5 * cell;
  const Bounds bounds = bounds_of(outline).grown(std::max(-depth_m, 0.0));
  const int x_end = clamped_cell(bounds.high.x, cell, grid.width());
  const int y_end = clamped_cell(bounds.high.y, cell, grid.height());
  for (int y = clamped_cell(bounds.low.y, cell, grid.height()); y <= y_end; ++y) {
    for (int x = clamped_cell(bounds.low.x, cell, grid.width()); x <= x_end; ++x) {
      square.centre = {(x + 0.5) * cell, (y + 0.5) * cell};
      if (separation(square, outline).distance_m < -depth_m) grid[{x, y}] = Cell::occupied;
    }
  }
}

}  // namespace

void draw(std::span<const Shape> shapes, OccupancyGrid& grid) {
  for (const Shape& shape : shapes) {
    Shape inside = shape;
    inside.pose = between(grid.origin(), shape.pose);
    draw_in_frame(outline_of(inside), edge_m, grid);
  }
}

void draw(const TriangleMesh& mesh, double z_low_m, double z_high_m, OccupancyGrid& grid) {
  std::vector<Outline> pieces;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Triangle triangle = mesh.triangle(i);
    for (SpaceVector& corner : triangle.corners) {
      const Pose inside = between(grid.origin(), {corner.x, corner.y, 0});
      corner = {inside.x, inside.y, corner.z};
    }
    pieces.clear();
    cover(triangle, z_low_m, z_high_m, pieces);
    for (const Outline& piece : pieces) draw_in_frame(piece, -edge_m, grid);
  }
}

}  // namespace waitpoint::world
