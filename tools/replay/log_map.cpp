// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/log_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "core/error.hpp"
#include "core/occupancy_grid.hpp"
#include "tools/replay/spread_scans.hpp"

namespace waitpoint::tools {
namespace {

using playback::StampedPose;

constexpr double map_cell_m = 0.05;
constexpr double used_range_m = 25;   // beyond it, an error of heading displaces an echo by cells
constexpr double scans_apart = 0.05;  // metres, or radians
constexpr std::uint32_t wall_echoes_least = 2;
constexpr double occupied_least = 0.25;  // share of a cell's beams that end in it
constexpr char occupied = 0, unknown = static_cast<char>(205), free_space = static_cast<char>(254);

/// Calls `see(laser, echo, is_echo)` for each beam of the scans: up to its echo, or the range used.
template <class See>
void for_each_beam(const logs::SensorLog& log, std::span<const StampedPose> trajectory, See see) {
  for (const StampedPose& at : trajectory) {
    const logs::LoggedScan& scan = log.scans[at.scan];
    const Pose laser = compose(at.pose, log.mount);
    for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
      const double range_m = scan.range_m[i];
      if (!(range_m > 0 && range_m < scan.range_max_m)) continue;
      const auto [s, c] =
          exact::sincos(laser.heading + scan.first_angle_rad + static_cast<double>(i) * scan.angle_step_rad);
      const double seen_m = std::min(range_m, used_range_m);
      see(laser.position(), laser.position() + seen_m * Point{c, s}, range_m <= used_range_m);
    }
  }
}

/// Echoes and passing beams by cell, in tiles that exist where beams were: a long way crosses few of its rectangle's.
class Grid {
 public:
  Grid(const logs::SensorLog& log, std::span<const StampedPose> trajectory) {
    find_extent(log, trajectory);
    for_each_beam(log, trajectory, [this](Point from, Point to, bool is_echo) { add(from, to, is_echo); });
  }

  Point low() const { return low_; }
  std::string image() const {
    std::string text = fmt::format("P5\n{} {}\n255\n", width_, height_);
    text.reserve(text.size() + width_ * height_);
    for (std::size_t row = height_; row-- > 0;)
      for (std::size_t column = 0; column < width_; ++column) text += grey({column, row});
    return text;
  }

 private:
  static constexpr std::size_t tile_side = 64;
  struct Cell {
    std::size_t column, row;  // rows from below
    bool operator==(const Cell&) const = default;
  };
  struct Counts {
    std::uint32_t echoes = 0, passes = 0;
  };
  using Tile = std::array<Counts, tile_side * tile_side>;

  void find_extent(const logs::SensorLog& log, std::span<const StampedPose> trajectory) {
    Point high;
    bool is_empty = true;
    for_each_beam(log, trajectory, [&](Point from, Point to, bool) {
      for (const Point p : {from, to}) {
        low_ = is_empty ? p : Point{std::min(low_.x, p.x), std::min(low_.y, p.y)};
        high = is_empty ? p : Point{std::max(high.x, p.x), std::max(high.y, p.y)};
        is_empty = false;
      }
    });
    if (is_empty) throw BadInput(log.file, "no map: expected echoes at poses that are known, found none");
    low_ = {map_cell_m * std::floor(low_.x / map_cell_m), map_cell_m * std::floor(low_.y / map_cell_m)};
    width_ = static_cast<std::size_t>((high.x - low_.x) / map_cell_m) + 1;
    height_ = static_cast<std::size_t>((high.y - low_.y) / map_cell_m) + 1;
    if (width_ > static_cast<std::size_t>(OccupancyGrid::cells_max) / height_)
      throw BadInput(log.file, fmt::format("no map: expected at most {} cells of {} m, found {:.0f} x {:.0f} m",
                                           OccupancyGrid::cells_max, map_cell_m, high.x - low_.x, high.y - low_.y));
    tiles_a_row_ = width_ / tile_side + 1;
    tiles_.resize(tiles_a_row_ * (height_ / tile_side + 1));
  }
  std::size_t tile(Cell at) const { return at.row / tile_side * tiles_a_row_ + at.column / tile_side; }
  static std::size_t within_tile(Cell at) { return at.row % tile_side * tile_side + at.column % tile_side; }
  Counts& counts(Cell at) {
    std::unique_ptr<Tile>& of_cell = tiles_[tile(at)];
    if (of_cell == nullptr) of_cell = std::make_unique<Tile>();
    return (*of_cell)[within_tile(at)];
  }
  Cell cell(Point p) const {
    const auto column = static_cast<std::size_t>((p.x - low_.x) / map_cell_m),
               row = static_cast<std::size_t>((p.y - low_.y) / map_cell_m);
    return {std::min(column, width_ - 1), std::min(row, height_ - 1)};
  }
  // Samples a cell apart along the beam; the last cell is the echo's.
  void add(Point from, Point to, bool is_echo) {
    const double length_m = length(to - from);
    const auto steps = static_cast<int>(length_m / map_cell_m);
    const Cell last = cell(to);
    for (int i = 0; i < steps; ++i) {
      const Cell passed = cell(from + (i * map_cell_m / length_m) * (to - from));
      if (passed != last) ++counts(passed).passes;
    }
    if (is_echo) ++counts(last).echoes;
  }
  char grey(Cell at) const {
    const std::unique_ptr<Tile>& of_cell = tiles_[tile(at)];
    if (of_cell == nullptr) return unknown;
    const auto [echoes, passes] = (*of_cell)[within_tile(at)];
    const double all = static_cast<double>(echoes) + static_cast<double>(passes);
    if (echoes >= wall_echoes_least && static_cast<double>(echoes) >= occupied_least * all) return occupied;
    return passes > 0 ? free_space : unknown;
  }

  Point low_;
  std::size_t width_ = 0, height_ = 0;
  std::size_t tiles_a_row_ = 0;
  std::vector<std::unique_ptr<Tile>> tiles_;  // null: no beam was there
};

}  // namespace

LogMap log_map(const std::filesystem::path& file, const logs::SensorLog& log, std::span<const StampedPose> trajectory) {
  const Grid grid(log, spread_scans(trajectory, scans_apart));
  LogMap map;
  map.image = grid.image();
  map.yaml = fmt::format(
      "image: {}\nresolution: {}\norigin: [{:.3f}, {:.3f}, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
      image_of(file).filename().string(), map_cell_m, grid.low().x, grid.low().y);
  return map;
}

std::filesystem::path image_of(const std::filesystem::path& file) {
  return std::filesystem::path(file).replace_extension(".pgm");
}

}  // namespace waitpoint::tools
