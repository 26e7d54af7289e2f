// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/obstacle_memory.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/exact_batch.hpp"

namespace waitpoint::ndd {
namespace {

constexpr std::size_t remembered_max = 1024;
constexpr double spacing_m = 0.03;    // between remembered points along a surface
constexpr double occlusion_m = 0.15;  // a beam that ends this much before a point does not test it

}  // namespace

ObstacleMemory::ObstacleMemory(const Parameters& parameters) : parameters_(parameters) {}

void ObstacleMemory::see(const Pose& robot, const posters::Echoes& echoes) {
  const posters::LaserReading& scan = echoes.scan;
  const Pose device = compose(robot, echoes.mount);
  keep_newest(robot);
  seen_ = scan.date;
  drop_contradicted(device, scan);
  scan_.clear();
  std::array<double, exact::batch> range, angle, sine, cosine;
  std::size_t count = 0;
  const auto enter = [&] {
    exact::sincos(std::span(angle).first(count), sine, cosine);
    for (std::size_t i = 0; i < count; ++i)
      scan_.push_back({device.x + range[i] * cosine[i], device.y + range[i] * sine[i]});
    count = 0;
  };
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    range[count] = scan.range_m[i];
    if (range[count] >= scan.range_max_m || range[count] >= parameters_.diagram_range_m) continue;
    angle[count] = device.heading + scan.first_angle_rad + static_cast<double>(i) * scan.angle_step_rad;
    if (++count == exact::batch) enter();
  }
  enter();
}

void ObstacleMemory::keep_newest(const Pose& robot) {
  const double reach = parameters_.memory_range_m;
  bool any = false;
  Point last;
  for (const Point p : scan_) {
    const Point from_robot = p - robot.position(), from_last = p - last;
    if (dot(from_robot, from_robot) > reach * reach) continue;
    if (any && dot(from_last, from_last) < spacing_m * spacing_m) continue;
    past_.push_back({p, seen_});
    last = p;
    any = true;
  }
}

void ObstacleMemory::drop_contradicted(const Pose& device, const posters::LaserReading& scan) {
  const double reach = parameters_.memory_range_m, beams = static_cast<double>(scan.range_m.size());
  const exact::SinCos facing = exact::sincos(device.heading);
  const Duration age_max = Duration::from_seconds(parameters_.memory_age_s);
  // True if a beam passes through a point at this bearing from the device.
  const auto is_contradicted = [&](double bearing, double square) {
    const double beam =
        (exact::wrap_angle(bearing - scan.first_angle_rad - 0.5 * beams * scan.angle_step_rad)) / scan.angle_step_rad +
        0.5 * beams;
    if (beam < 0 || beam > beams - 1) return false;  // out of view
    const auto below = static_cast<std::size_t>(beam);
    const std::size_t above = below + (beam > static_cast<double>(below) ? 1 : 0);
    const double range = std::min(scan.range_m[below], scan.range_m[above]);
    return range + occlusion_m >= std::sqrt(square);
  };
  std::array<Remembered, exact::batch> near;
  std::array<double, exact::batch> ahead, aside, square, bearing;
  std::size_t count = 0, kept = 0;
  const auto enter = [&] {
    exact::atan2(std::span(aside).first(count), std::span(ahead).first(count), bearing);
    for (std::size_t i = 0; i < count; ++i)
      if (!is_contradicted(bearing[i], square[i])) past_[kept++] = near[i];
    count = 0;
  };
  for (const Remembered& r : past_) {
    const Point d = r.point - device.position();
    square[count] = dot(d, d);
    if (square[count] > reach * reach || seen_ - r.seen > age_max) continue;
    near[count] = r;
    ahead[count] = facing.cos * d.x + facing.sin * d.y;
    aside[count] = facing.cos * d.y - facing.sin * d.x;
    if (++count == exact::batch) enter();
  }
  enter();
  past_.resize(kept);
  if (past_.size() > remembered_max) {
    past_.erase(past_.begin(), past_.begin() + static_cast<std::ptrdiff_t>(past_.size() - remembered_max));
  }
}

void ObstacleMemory::points_from(const Pose& robot, std::vector<Point>& points) const {
  points.clear();
  const exact::SinCos facing = exact::sincos(robot.heading);
  const auto add = [&](Point p) {
    const double dx = p.x - robot.x, dy = p.y - robot.y;
    points.push_back({facing.cos * dx + facing.sin * dy, facing.cos * dy - facing.sin * dx});
  };
  for (const Point p : scan_) add(p);
  for (const Remembered& r : past_) add(r.point);
}

}  // namespace waitpoint::ndd
