// SPDX-License-Identifier: BSD-3-Clause
#include "tests/modules/sick/synthetic_room.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace waitpoint::synthetic {
namespace {

// Calls visit(beam) for the beams between two bearings less than half a turn apart.
template <class Visit>
void for_beams(double from_rad, double to_rad, double first_rad, double step_rad, std::size_t beams, Visit visit) {
  double width = exact::wrap_angle(to_rad - from_rad);
  if (width < 0) {
    from_rad = to_rad;
    width = -width;
  }
  for (double turn : {-2.0 * exact::pi, 0.0, 2.0 * exact::pi}) {
    const double low = (from_rad + turn - first_rad) / step_rad;
    const double high = low + width / step_rad;
    const auto begin = static_cast<std::int64_t>(std::max(0.0, std::ceil(low - 1e-9)));
    const auto end = static_cast<std::int64_t>(std::min(beams - 1.0, std::floor(high + 1e-9)));
    for (std::int64_t beam = begin; beam <= end; ++beam) visit(static_cast<std::size_t>(beam));
  }
}

}  // namespace

Raster::Raster(double cell, Point corner, double width_m, double height_m)
    : cell_m(cell),
      origin(corner),
      columns(static_cast<int>(std::ceil(width_m / cell))),
      rows(static_cast<int>(std::ceil(height_m / cell))),
      occupied(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0) {}

void Raster::draw(Point from, Point to) {
  const int steps = static_cast<int>(length(to - from) / cell_m * 10) + 1;
  for (int i = 0; i <= steps; ++i) {
    const Point p = from + (static_cast<double>(i) / steps) * (to - from);
    const int column = static_cast<int>(std::floor((p.x - origin.x) / cell_m));
    const int row = static_cast<int>(std::floor((p.y - origin.y) / cell_m));
    if (column < 0 || row < 0 || column >= columns || row >= rows) continue;
    occupied[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)] = 1;
  }
}

void Room::add_box(const Pose& centre, double length_m, double width_m) {
  const double l = 0.5 * length_m, w = 0.5 * width_m;
  const std::array<Point, 4> corner{transform(centre, {l, w}), transform(centre, {-l, w}), transform(centre, {-l, -w}),
                                    transform(centre, {l, -w})};
  for (std::size_t i = 0; i < 4; ++i) add_wall(corner[i], corner[(i + 1) % 4]);
}

void Room::see_wall(const Pose& pose, const Wall& wall, std::span<double> range_m) const {
  const Point a = between(pose, {wall.from.x, wall.from.y, 0}).position();
  const Point d = between(pose, {wall.to.x, wall.to.y, 0}).position() - a;
  const Point b = a + d;
  const double area = cross(a, d);
  if (area == 0) return;
  for_beams(exact::atan2(a.y, a.x), exact::atan2(b.y, b.x), first_rad_, step_rad_, range_m.size(), [&](std::size_t i) {
    const auto [s, c] = exact::sincos(first_rad_ + static_cast<double>(i) * step_rad_);
    const double across = c * d.y - s * d.x;
    if (across == 0) return;
    const double r = area / across;
    if (r > 0) range_m[i] = std::min(range_m[i], r);
  });
}

void Room::see_disc(const Pose& pose, const Disc& disc, std::span<double> range_m) const {
  const Point c = between(pose, {disc.centre.x, disc.centre.y, 0}).position();
  const double distance = length(c);
  if (distance <= disc.radius_m || distance > 100) return;
  const double bearing = exact::atan2(c.y, c.x), half = 1.6 * disc.radius_m / distance;
  for_beams(bearing - half, bearing + half, first_rad_, step_rad_, range_m.size(), [&](std::size_t i) {
    const auto [s, co] = exact::sincos(first_rad_ + static_cast<double>(i) * step_rad_);
    const double along = co * c.x + s * c.y, off = co * c.y - s * c.x;
    const double rest = disc.radius_m * disc.radius_m - off * off;
    if (rest < 0 || along < 0) return;
    range_m[i] = std::min(range_m[i], along - std::sqrt(rest));
  });
}

double Room::see_raster(Point from, Point direction, double range_m) const {
  const Raster& r = raster_;
  const double x = (from.x - r.origin.x) / r.cell_m, y = (from.y - r.origin.y) / r.cell_m;
  int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const int step_x = direction.x > 0 ? 1 : -1, step_y = direction.y > 0 ? 1 : -1;
  const double far = 1e30;
  const double delta_x = direction.x != 0 ? r.cell_m / std::fabs(direction.x) : far;
  const double delta_y = direction.y != 0 ? r.cell_m / std::fabs(direction.y) : far;
  double next_x = direction.x != 0 ? (direction.x > 0 ? column + 1 - x : x - column) * delta_x : far;
  double next_y = direction.y != 0 ? (direction.y > 0 ? row + 1 - y : y - row) * delta_y : far;
  double at = 0;
  while (at < range_m) {
    if (column < 0 || row < 0 || column >= r.columns || row >= r.rows) return range_m;
    if (r.occupied[static_cast<std::size_t>(row) * static_cast<std::size_t>(r.columns) +
                   static_cast<std::size_t>(column)]) {
      return at;
    }
    if (next_x < next_y) {
      at = next_x;
      next_x += delta_x;
      column += step_x;
    } else {
      at = next_y;
      next_y += delta_y;
      row += step_y;
    }
  }
  return range_m;
}

void Room::scan(const Pose& pose, const LaserModel& laser, const RandomStream& noise, std::uint64_t tick,
                std::span<const Disc> others, posters::LaserReading& reading) const {
  step_rad_ = laser.field_of_view_rad / (laser.beams - 1);
  first_rad_ = -0.5 * laser.field_of_view_rad;
  std::array<double, world::Lasers::count_max> all{};
  const std::span<double> range_m(all.data(), laser.beams);
  std::fill(range_m.begin(), range_m.end(), laser.range_m_max);
  for (const Wall& wall : walls_) see_wall(pose, wall, range_m);
  for (const Disc& disc : discs_) see_disc(pose, disc, range_m);
  for (const Disc& disc : others) see_disc(pose, disc, range_m);
  reading.number += 1;
  reading.first_angle_rad = first_rad_;
  reading.angle_step_rad = step_rad_;
  reading.range_max_m = laser.range_m_max;
  reading.range_m.resize(laser.beams);
  for (std::uint32_t i = 0; i < laser.beams; ++i) {
    double r = range_m[i];
    if (raster_.columns > 0) {
      const auto [s, c] = exact::sincos(pose.heading + first_rad_ + i * step_rad_);
      r = see_raster(pose.position(), {c, s}, r);
    }
    if (r < laser.range_m_max) {
      const double growth = r > 8 ? 1.0 + (r - 8) / 12.0 : 1.0;
      r += laser.bias_m + laser.noise_m * growth * noise.normal_pair(tick, i / 2)[i % 2];
      if (laser.resolution_m > 0) r = laser.resolution_m * std::nearbyint(r / laser.resolution_m);
      r = std::clamp(r, 0.0, laser.range_m_max);
    }
    reading.range_m[i] = static_cast<float>(r);
  }
}

}  // namespace waitpoint::synthetic
