// SPDX-License-Identifier: BSD-3-Clause
#include "modules/locate/map_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace waitpoint::locate {
namespace {

using matching::SurfacePoint;

// Neighbours within this distance show the wall of a side.
constexpr double wall_m = 0.25;
// They are on one line if their standard deviation about it is at most this many cells: that of a stair of cells.
constexpr double straight_cells = 0.5;
constexpr std::size_t neighbours_min = 4;
constexpr int edge_cells = 4;

/// The sides in the map's own frame, whose x axis points along its rows, and for each cell the first of its sides.
class Sides {
 public:
  explicit Sides(const OccupancyGrid& map) : map_(map) {
    first_.reserve(map.cells().size() + 1);
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        first_.push_back(static_cast<std::uint32_t>(points_.size()));
        if (map[{x, y}] == Cell::occupied) add_sides_of({x, y});
      }
    }
    first_.push_back(static_cast<std::uint32_t>(points_.size()));
  }

  std::vector<SurfacePoint> smoothed() const {
    std::vector<SurfacePoint> result;
    result.reserve(points_.size());
    for (int y = 0; y < map_.height(); ++y)
      for (int x = 0; x < map_.width(); ++x)
        for (std::uint32_t i = first(x, y); i < first(x + 1, y); ++i) result.push_back(on_its_wall(points_[i], x, y));
    return result;
  }

 private:
  std::uint32_t first(int x, int y) const {
    return first_[static_cast<std::size_t>(y) * static_cast<std::size_t>(map_.width()) + static_cast<std::size_t>(x)];
  }

  // True if free cells lie on that side, perhaps beyond the unknown ones of a wall's blurred edge: then a robot may see
  // it.
  bool shows(CellIndex cell, CellIndex towards) const {
    for (int k = 1; k <= edge_cells; ++k) {
      const CellIndex beyond = {cell.x + k * towards.x, cell.y + k * towards.y};
      if (!map_.contains(beyond) || map_[beyond] == Cell::occupied) return false;
      if (map_[beyond] == Cell::free) return true;
    }
    return false;
  }

  void add_sides_of(CellIndex cell) {
    constexpr std::array<CellIndex, 4> directions = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    const double edge_m = map_.resolution_m();
    for (const CellIndex towards : directions) {
      if (!shows(cell, towards)) continue;
      const Point normal = {static_cast<double>(towards.x), static_cast<double>(towards.y)};
      points_.push_back({Point{(cell.x + 0.5) * edge_m, (cell.y + 0.5) * edge_m} + 0.5 * edge_m * normal, normal});
    }
  }

  // The foot of a side on the line through its neighbours, if they are on one: the total least squares line.
  SurfacePoint on_its_wall(const SurfacePoint& side, int x, int y) const {
    const int reach = static_cast<int>(wall_m / map_.resolution_m());
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
    for (int v = std::max(0, y - reach); v <= std::min(map_.height() - 1, y + reach); ++v) {
      const std::uint32_t end = first(std::min(map_.width() - 1, x + reach) + 1, v);
      for (std::uint32_t i = first(std::max(0, x - reach), v); i < end; ++i) {
        const Point away = points_[i].position - side.position;
        if (dot(away, away) > wall_m * wall_m || dot(points_[i].normal, side.normal) < 0) continue;
        ++n;
        sx += away.x;
        sy += away.y;
        sxx += away.x * away.x;
        sxy += away.x * away.y;
        syy += away.y * away.y;
      }
    }
    if (n < neighbours_min) return side;
    const Point mean = {sx / n, sy / n};
    const double xx = sxx / n - mean.x * mean.x, xy = sxy / n - mean.x * mean.y, yy = syy / n - mean.y * mean.y;
    const double half_difference = exact::hypot(0.5 * (xx - yy), xy);
    const double across = 0.5 * (xx + yy) - half_difference;
    if (across > straight_cells * map_.resolution_m() * straight_cells * map_.resolution_m()) return side;
    const double along_rad = 0.5 * exact::atan2(2 * xy, xx - yy);
    const auto [s, c] = exact::sincos(along_rad);
    Point normal = {-s, c};
    if (dot(normal, side.normal) < 0) normal = -1 * normal;
    return {side.position + dot(mean, normal) * normal, normal};
  }

  const OccupancyGrid& map_;
  std::vector<SurfacePoint> points_;
  std::vector<std::uint32_t> first_;
};

}  // namespace

std::vector<SurfacePoint> surface_of(const OccupancyGrid& map) {
  std::vector<SurfacePoint> points = Sides(map).smoothed();
  const Pose turn = {0, 0, map.origin().heading};
  for (SurfacePoint& point : points) point = {transform(map.origin(), point.position), transform(turn, point.normal)};
  return points;
}

}  // namespace waitpoint::locate
