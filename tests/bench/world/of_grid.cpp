// SPDX-License-Identifier: BSD-3-Clause
// Occupied cells of 5 cm, and beams that step from cell to cell (Amanatides and Woo): the method of most 2D simulators.
// Robots are drawn into the grid at their places, and removed for their own scans.
#include <algorithm>
#include <cmath>

#include "tests/bench/world/contenders.hpp"
#include "world/planar/separation.hpp"

namespace waitpoint::bench {
namespace {

constexpr double cell_m = 0.05;
constexpr int border = 4;  // cells around the place

class ByGrid : public Contender {
 public:
  explicit ByGrid(const Place& place)
      : columns_(static_cast<int>(std::ceil(place.length_m / cell_m)) + 2 * border),
        rows_(static_cast<int>(std::ceil(place.width_m / cell_m)) + 2 * border),
        cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)),
        robots_(place.robots) {
    for (const world::Shape& shape : place.obstacles) draw(shape, 1);
    for (const world::Shape& robot : robots_) draw(robot, 1);
  }

  void place(std::span<const world::Shape> robots) override {
    for (const world::Shape& robot : robots_) draw(robot, -1);
    robots_.assign(robots.begin(), robots.end());
    for (const world::Shape& robot : robots_) draw(robot, 1);
  }

  void scan(const Pose& at, std::uint32_t own, std::span<double, beams> ranges_m) override {
    if (own < robots_.size()) draw(robots_[own], -1);
    const auto [s, c] = exact::sincos(at.heading);
    for (std::size_t i = 0; i < beams; ++i) {
      const Point d = directions()[i];
      ranges_m[i] = range_m(at.position(), {c * d.x - s * d.y, s * d.x + c * d.y});
    }
    if (own < robots_.size()) draw(robots_[own], 1);
  }

 private:
  static int column(double x_m) { return static_cast<int>(std::floor(x_m / cell_m)) + border; }

  // Adds `count` to the cells whose middles the shape covers, or nearly.
  void draw(const world::Shape& shape, int count) {
    const world::Outline outline = world::outline_of(shape);
    const world::Bounds b = world::bounds_of(outline);
    for (int row = std::max(column(b.low.y), 0); row <= std::min(column(b.high.y), rows_ - 1); ++row) {
      for (int i = std::max(column(b.low.x), 0); i <= std::min(column(b.high.x), columns_ - 1); ++i) {
        world::Outline middle;
        middle.centre = {(i - border + 0.5) * cell_m, (row - border + 0.5) * cell_m};
        if (world::separation(outline, middle).distance_m > 0.4 * cell_m) continue;
        auto& cell =
            cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i)];
        cell = static_cast<std::uint8_t>(cell + count);
      }
    }
  }

  double range_m(Point from, Point d) const {
    int i = column(from.x), row = column(from.y);
    const int step_i = d.x > 0 ? 1 : -1, step_row = d.y > 0 ? columns_ : -columns_;
    const double every_x = cell_m / std::fabs(d.x), every_y = cell_m / std::fabs(d.y);
    double to_x = ((i - border + (d.x > 0 ? 1 : 0)) * cell_m - from.x) / d.x;
    double to_y = ((row - border + (d.y > 0 ? 1 : 0)) * cell_m - from.y) / d.y;
    const std::uint8_t* cell = cells_.data() + static_cast<std::ptrdiff_t>(row) * columns_ + i;
    double range = 0;
    while (*cell == 0) {
      if (to_x < to_y) {
        range = to_x;
        to_x += every_x;
        cell += step_i;
      } else {
        range = to_y;
        to_y += every_y;
        cell += step_row;
      }
      if (range >= range_max_m) return range_max_m;
    }
    return range;
  }

  int columns_, rows_;
  std::vector<std::uint8_t> cells_;
  std::vector<world::Shape> robots_;
};

}  // namespace

std::unique_ptr<Contender> grid_of_5_cm(const Place& place) { return std::make_unique<ByGrid>(place); }

}  // namespace waitpoint::bench
