// SPDX-License-Identifier: BSD-3-Clause
// Floors drawn as text, and the scans of a laser on them.
#pragma once

#include <string>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "modules/matching/surface.hpp"

namespace waitpoint::locate {

/// Rows from the top, '#' occupied, other characters free; each character is `scale` x `scale` cells of 0.1 m.
inline OccupancyGrid floor_of(const std::vector<std::string>& rows, int scale = 5) {
  const int width = static_cast<int>(rows[0].size()) * scale, height = static_cast<int>(rows.size()) * scale;
  OccupancyGrid map(width, height, 0.1, {}, Cell::free);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (rows[static_cast<std::size_t>((height - 1 - y) / scale)][static_cast<std::size_t>(x / scale)] == '#')
        map[{x, y}] = Cell::occupied;
  return map;
}

/// A scan of 181 beams ahead, to 12 m, from a robot at `pose`.
inline std::vector<matching::SurfacePoint> scan_at(const OccupancyGrid& map, const Pose& pose) {
  posters::Echoes echoes;
  echoes.scan.first_angle_rad = -exact::pi / 2;
  echoes.scan.angle_step_rad = exact::pi / 180;
  echoes.scan.range_max_m = 12;
  for (int beam = 0; beam <= 180; ++beam) {
    const auto [s, c] = exact::sincos(pose.heading + echoes.scan.first_angle_rad + beam * echoes.scan.angle_step_rad);
    double range_m = 0;
    while (range_m < echoes.scan.range_max_m) {
      const auto cell = map.cell_at({pose.x + range_m * c, pose.y + range_m * s});
      if (cell && map[*cell] == Cell::occupied) break;
      range_m += 0.005;
    }
    echoes.scan.range_m.push_back(static_cast<float>(range_m));
  }
  std::vector<matching::SurfacePoint> points;
  matching::surface_of(echoes, {}, points);
  return points;
}

}  // namespace waitpoint::locate
