// SPDX-License-Identifier: BSD-3-Clause
#include "core/footprint.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint {

Footprint::Footprint(std::span<const Point> corners, double radius_m) : radius_m_(radius_m), inner_radius_m_(radius_m) {
  if (corners.size() < 3) return;
  double inner_m = radius_m;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point start = corners[i], side = corners[(i + 1) % corners.size()] - start;
    const double length_m = length(side);
    if (length_m == 0) continue;
    sides_.push_back({start, (1 / length_m) * side, length_m, 0});
    sides_.back().beyond_m = dot(sides_.back().outward(), start);
    inner_m = std::min(inner_m, sides_.back().beyond_m);
  }
  if (inner_m > 0)
    inner_radius_m_ = inner_m;
  else
    sides_.clear();
}

double Footprint::reach_m(Point p) const {
  if (is_disc()) return radius_m_;
  double reach_m = radius_m_;
  const double distance_m = std::sqrt(dot(p, p));
  for (const Side& side : sides_) {
    const double towards = dot(side.outward(), p);
    if (towards > 0) reach_m = std::min(reach_m, side.beyond_m * distance_m / towards);
  }
  return reach_m;
}

double Footprint::distance_m(Point p) const {
  if (is_disc()) return std::max(0.0, std::sqrt(dot(p, p)) - radius_m_);
  bool inside = true;
  double square = -1;
  for (const Side& side : sides_) {
    const Point d = p - side.start;
    if (dot(side.outward(), d) <= 0) continue;
    inside = false;
    const Point rest = d - std::clamp(dot(side.along, d), 0.0, side.length_m) * side.along;
    if (square < 0 || dot(rest, rest) < square) square = dot(rest, rest);
  }
  return inside ? 0 : std::sqrt(square);
}

std::vector<Point> Footprint::hull_points(double spacing_m) const {
  std::vector<Point> points;
  for (const Side& side : sides_) {
    const auto parts = static_cast<int>(std::ceil(side.length_m / spacing_m));
    for (int k = 0; k < parts; ++k) points.push_back(side.start + (side.length_m * k / parts) * side.along);
  }
  return points;
}

}  // namespace waitpoint
