// SPDX-License-Identifier: BSD-3-Clause
#include "tests/world/brute_force.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace waitpoint::world::brute_force {
namespace {

using Real = long double;
constexpr Real none = std::numeric_limits<Real>::infinity();

// The distance along the ray to the segment from (ax, ay) to (bx, by).
Real cross_edge(const Line& line, Real ax, Real ay, Real bx, Real by) {
  const Real ex = bx - ax, ey = by - ay, px = ax - line.x, py = ay - line.y;
  Real below = line.dx * ey - line.dy * ex, t = px * ey - py * ex, s = px * line.dy - py * line.dx;
  if (below < 0) {
    below = -below;
    t = -t;
    s = -s;
  }
  return below > 0 && t >= 0 && s >= 0 && s <= below ? t / below : none;
}

Real hit_corners(const std::vector<Real>& xs, const std::vector<Real>& ys, const Line& line) {
  bool inside = true;
  Real nearest = none;
  for (std::size_t i = 0; i < xs.size(); ++i) {
    const std::size_t j = (i + 1) % xs.size();
    inside = inside && (xs[j] - xs[i]) * (line.y - ys[i]) - (ys[j] - ys[i]) * (line.x - xs[i]) >= 0;
    nearest = std::min(nearest, cross_edge(line, xs[i], ys[i], xs[j], ys[j]));
  }
  return inside ? 0 : nearest;
}

Real hit_cylinder(const Shape& cylinder, const Line& line) {
  const Real px = line.x - cylinder.pose.x, py = line.y - cylinder.pose.y;
  const Real a = line.dx * line.dx + line.dy * line.dy;
  const Real b = px * line.dx + py * line.dy;
  const Real c = px * px + py * py - static_cast<Real>(cylinder.radius_m) * cylinder.radius_m;
  if (c <= 0) return 0;
  const Real discriminant = b * b - a * c;
  if (discriminant < 0 || b > 0) return none;
  return (-b - sqrtl(discriminant)) / a;
}

}  // namespace

Shapes::Shapes(const std::vector<Shape>& shapes) {
  for (const Shape& shape : shapes) {
    Item item = {shape, {}, {}};
    const Real c = cosl(shape.pose.heading), s = sinl(shape.pose.heading);
    const Real l = shape.length_m / 2.0L, w = shape.width_m / 2.0L;
    std::vector<Real> us = {l, -l, -l, l}, vs = {w, w, -w, -w};
    if (shape.kind == Shape::Kind::prism) {
      us.clear(), vs.clear();
      for (const ConvexPolygon::Side& side : shape.polygon->sides())
        us.push_back(side.start.x), vs.push_back(side.start.y);
    }
    for (std::size_t i = 0; i < us.size(); ++i) {
      item.x.push_back(shape.pose.x + c * us[i] - s * vs[i]);
      item.y.push_back(shape.pose.y + s * us[i] + c * vs[i]);
    }
    items_.push_back(item);
  }
}

long double Shapes::range(const Line& line, double height_m, double range_max_m) const {
  Real nearest = range_max_m;
  for (const auto& [shape, x, y] : items_) {
    if (height_m < shape.z_low_m || height_m > shape.z_high_m) continue;
    nearest =
        std::min(nearest, shape.kind == Shape::Kind::cylinder ? hit_cylinder(shape, line) : hit_corners(x, y, line));
  }
  return nearest;
}

bool Shapes::grazes(const Line& line, double height_m, double range_max_m, double by_m, double jump_m) const {
  const Line left = {line.x - by_m * line.dy, line.y + by_m * line.dx, line.dx, line.dy};
  const Line right = {line.x + by_m * line.dy, line.y - by_m * line.dx, line.dx, line.dy};
  return fabsl(range(left, height_m, range_max_m) - range(right, height_m, range_max_m)) > jump_m;
}

}  // namespace waitpoint::world::brute_force
