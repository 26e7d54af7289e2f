// SPDX-License-Identifier: BSD-3-Clause
// Positions in the plane: metres, radians, heading counter-clockwise from the x axis.
//
// `a + b`-like composition is written compose(a, b): b is given in the frame of a, the result in the frame of a's
// frame. between(a, b) is b seen from a, so that compose(a, between(a, b)) is b.
#pragma once

#include "core/exact_math.hpp"

namespace waitpoint {

struct Point {
  double x = 0, y = 0;

  friend constexpr bool operator==(Point, Point) = default;
  friend constexpr Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Point operator*(double k, Point a) { return {k * a.x, k * a.y}; }
};

constexpr double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
constexpr double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
inline double length(Point a) { return exact::hypot(a.x, a.y); }

struct Pose {
  double x = 0, y = 0, heading = 0;

  constexpr Point position() const { return {x, y}; }
  friend constexpr bool operator==(const Pose&, const Pose&) = default;
};

/// The point `p`, given in the frame of `frame`, in the outer frame.
inline Point transform(const Pose& frame, Point p) {
  const auto [s, c] = exact::sincos(frame.heading);
  return {frame.x + (c * p.x - s * p.y), frame.y + (s * p.x + c * p.y)};
}

/// The pose `b`, given in the frame of `a`, in the outer frame. The heading is wrapped to (-pi, pi].
inline Pose compose(const Pose& a, const Pose& b) {
  const Point p = transform(a, b.position());
  return {p.x, p.y, exact::wrap_angle(a.heading + b.heading)};
}

/// `b` as seen from `a`. The heading is wrapped to (-pi, pi].
inline Pose between(const Pose& a, const Pose& b) {
  const auto [s, c] = exact::sincos(a.heading);
  const double dx = b.x - a.x, dy = b.y - a.y;
  return {c * dx + s * dy, c * dy - s * dx, exact::wrap_angle(b.heading - a.heading)};
}

/// `fraction` of the way from `a` (0) to `b` (1), the heading along the shorter turn. Meant for poses that are close.
inline Pose interpolate(const Pose& a, const Pose& b, double fraction) {
  const Pose whole = between(a, b);
  return compose(a, {fraction * whole.x, fraction * whole.y, fraction * whole.heading});
}

}  // namespace waitpoint
