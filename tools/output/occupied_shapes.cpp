// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/occupied_shapes.hpp"

namespace waitpoint::tools {
namespace {

world::Shape box(const OccupancyGrid& grid, int y, int begin, int end) {
  world::Shape shape;
  const double edge_m = grid.resolution_m();
  shape.length_m = (end - begin) * edge_m;
  shape.width_m = edge_m;
  const Point middle{(begin + end) * edge_m / 2, (y + 0.5) * edge_m};
  const Point at = transform(grid.origin(), middle);
  shape.pose = {at.x, at.y, grid.origin().heading};
  return shape;
}

}  // namespace

std::vector<world::Shape> occupied_shapes(const nodes::ShownMessage& message) {
  std::vector<world::Shape> shapes;
  if (!message.grid) return shapes;
  const OccupancyGrid& grid = *message.grid;
  for (int y = 0; y < grid.height(); ++y)
    for (int x = 0; x < grid.width(); ++x) {
      if (grid[{x, y}] != Cell::occupied) continue;
      const int begin = x;
      while (x < grid.width() && grid[{x, y}] == Cell::occupied) ++x;
      shapes.push_back(box(grid, y, begin, x));
    }
  return shapes;
}

}  // namespace waitpoint::tools
