// SPDX-License-Identifier: BSD-3-Clause
#include "core/occupancy_grid.hpp"

#include <cmath>

namespace waitpoint {

OccupancyGrid::OccupancyGrid(int width, int height, double resolution_m, const Pose& origin, Cell fill)
    : width_(width), height_(height), resolution_m_(resolution_m), origin_(origin) {
  WAITPOINT_CHECK(width > 0 && height > 0 && std::int64_t{width} * height <= cells_max,
                  "a grid without cells, or with too many");
  WAITPOINT_CHECK(resolution_m > 0, "the size of a cell is not positive");
  cells_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill);
}

Point OccupancyGrid::centre(CellIndex c) const {
  return transform(origin_, {(c.x + 0.5) * resolution_m_, (c.y + 0.5) * resolution_m_});
}

std::optional<CellIndex> OccupancyGrid::cell_at(Point p) const {
  const Pose inside = between(origin_, {p.x, p.y, 0});
  const double x = std::floor(inside.x / resolution_m_), y = std::floor(inside.y / resolution_m_);
  if (!(x >= 0 && y >= 0 && x < width_ && y < height_)) return std::nullopt;
  return CellIndex{static_cast<int>(x), static_cast<int>(y)};
}

}  // namespace waitpoint
