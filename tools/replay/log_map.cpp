// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/log_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "tools/replay/spread_scans.hpp"

namespace waitpoint::tools {
namespace {

using playback::StampedPose;

constexpr double map_cell_m = 0.05;
constexpr double used_range_m = 25;   // beyond it, an error of heading displaces an echo by cells
constexpr double scans_apart = 0.05;  // metres, or radians
constexpr std::size_t cells_max = std::size_t{1} << 28;
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

class Grid {
 public:
  Grid(const logs::SensorLog& log, std::span<const StampedPose> trajectory) {
    find_extent(log, trajectory);
    for_each_beam(log, trajectory, [this](Point from, Point to, bool is_echo) { add(from, to, is_echo); });
  }

  Point low() const { return low_; }
  std::string image() const {
    std::string text = fmt::format("P5\n{} {}\n255\n", width_, height_);
    for (std::size_t row = height_; row-- > 0;)
      for (std::size_t column = 0; column < width_; ++column) text += grey(row * width_ + column);
    return text;
  }

 private:
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
    if (is_empty) throw BadInput("--map", "expected a log with echoes and poses, found none");
    low_ = {map_cell_m * std::floor(low_.x / map_cell_m), map_cell_m * std::floor(low_.y / map_cell_m)};
    width_ = static_cast<std::size_t>((high.x - low_.x) / map_cell_m) + 1;
    height_ = static_cast<std::size_t>((high.y - low_.y) / map_cell_m) + 1;
    if (width_ > cells_max / height_) throw BadInput("--map", "expected a trajectory within some kilometres");
    echoes_.resize(width_ * height_);
    passes_.resize(width_ * height_);
  }
  std::size_t cell(Point p) const {
    const auto x = static_cast<std::size_t>((p.x - low_.x) / map_cell_m),
               y = static_cast<std::size_t>((p.y - low_.y) / map_cell_m);
    return std::min(y, height_ - 1) * width_ + std::min(x, width_ - 1);
  }
  // Samples a cell apart along the beam; the last cell is the echo's.
  void add(Point from, Point to, bool is_echo) {
    const double length_m = length(to - from);
    const auto steps = static_cast<int>(length_m / map_cell_m);
    const std::size_t last = cell(to);
    for (int i = 0; i < steps; ++i) {
      const std::size_t passed = cell(from + (i * map_cell_m / length_m) * (to - from));
      if (passed != last) ++passes_[passed];
    }
    if (is_echo) ++echoes_[last];
  }
  char grey(std::size_t cell) const {
    const double all = static_cast<double>(echoes_[cell]) + static_cast<double>(passes_[cell]);
    if (echoes_[cell] >= wall_echoes_least && static_cast<double>(echoes_[cell]) >= occupied_least * all)
      return occupied;
    return passes_[cell] > 0 ? free_space : unknown;
  }

  Point low_;
  std::size_t width_ = 0, height_ = 0;
  std::vector<std::uint32_t> echoes_, passes_;  // by cell, rows from below
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
