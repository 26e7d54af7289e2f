// SPDX-License-Identifier: BSD-3-Clause
//
// The separating axis theorem on the four face directions of two boxes decides if they are disjoint, and gives the
// shortest separating translation if they are not. Disjoint convex polygons are nearest at a corner of one of them, so
// the distance is the least of eight distances from a corner to a box.
#include "world/planar/separation.hpp"

#include <cmath>

#include "core/error.hpp"

namespace waitpoint::world {
namespace {

Point reversed(Point v) { return {-v.x, -v.y}; }

// Of the box's core and the point; the normal points from the box to the point.
Separation box_to_point(const Outline& box, Point point) {
  const Point p = box.local(point);
  const double beyond_x = std::fabs(p.x) - box.half_length_m, beyond_y = std::fabs(p.y) - box.half_width_m;
  const Point side = {std::copysign(1.0, p.x), std::copysign(1.0, p.y)};
  if (beyond_x > 0 && beyond_y > 0) {
    const double distance = exact::hypot(beyond_x, beyond_y);
    return {distance, box.outward({side.x * (beyond_x / distance), side.y * (beyond_y / distance)})};
  }
  if (beyond_x > beyond_y) return {beyond_x, box.outward({side.x, 0})};
  return {beyond_y, box.outward({0, side.y})};
}

// The greatest separation of the boxes along a face direction of `a`: positive if one of these separates them.
Separation face_separation(const Outline& a, const Outline& b) {
  const Point d = a.local(b.centre);
  const double c = std::fabs(a.axis_cos * b.axis_cos + a.axis_sin * b.axis_sin);
  const double s = std::fabs(a.axis_cos * b.axis_sin - a.axis_sin * b.axis_cos);
  const double gap_x = std::fabs(d.x) - a.half_length_m - (c * b.half_length_m + s * b.half_width_m);
  const double gap_y = std::fabs(d.y) - a.half_width_m - (s * b.half_length_m + c * b.half_width_m);
  if (gap_x > gap_y) return {gap_x, a.outward({std::copysign(1.0, d.x), 0})};
  return {gap_y, a.outward({0, std::copysign(1.0, d.y)})};
}

Separation box_to_box(const Outline& a, const Outline& b) {
  const Separation by_a = face_separation(a, b), by_b = face_separation(b, a);
  const Separation widest =
      by_a.distance_m >= by_b.distance_m ? by_a : Separation{by_b.distance_m, reversed(by_b.normal)};
  if (widest.distance_m <= 0) return widest;
  Separation nearest = {HUGE_VAL, {}};
  for (const Point corner : core_points(b)) {
    const Separation s = box_to_point(a, corner);
    if (s.distance_m < nearest.distance_m) nearest = s;
  }
  for (const Point corner : core_points(a)) {
    const Separation s = box_to_point(b, corner);
    if (s.distance_m < nearest.distance_m) nearest = {s.distance_m, reversed(s.normal)};
  }
  return nearest;
}

Separation point_to_point(Point a, Point b) {
  const Point d = b - a;
  const double distance = length(d);
  if (distance == 0) return {0, {1, 0}};
  return {distance, {d.x / distance, d.y / distance}};
}

Separation of_segment_to_point(Point start, Point end, Point p) {
  const Point along = end - start;
  const double square = dot(along, along);
  const double part = square > 0 ? std::fmin(std::fmax(dot(p - start, along) / square, 0), 1) : 0;
  return point_to_point(start + part * along, p);
}

// Of the core and the point; the normal points to the point. A core of one point never overlaps another of one point.
Separation core_to_point(const CorePoints& core, Point p) {
  if (core.count() == 1) return point_to_point(core[0], p);
  Separation nearest = {HUGE_VAL, {}}, deepest = {-HUGE_VAL, {}};
  for (std::size_t i = 0; i < core.count(); ++i) {
    const Point start = core[i], end = core[(i + 1) % core.count()], along = end - start;
    const double length_m = length(along);
    if (length_m == 0) continue;
    const Point outward = {along.y / length_m, -along.x / length_m};
    const double beyond = dot(p - start, outward);
    if (beyond > deepest.distance_m) deepest = {beyond, outward};
    const Separation s = of_segment_to_point(start, end, p);
    if (s.distance_m < nearest.distance_m) nearest = s;
  }
  // All its points coincide, so no side has a normal.
  if (nearest.distance_m == HUGE_VAL) return point_to_point(core[0], p);
  return deepest.distance_m <= 0 ? deepest : nearest;
}

// The greatest separation of `b` from a side of `a`, along that side's outward normal.
Separation side_separation(const CorePoints& a, const CorePoints& b) {
  Separation widest = {-HUGE_VAL, {}};
  for (std::size_t i = 0; i < a.count() && a.count() > 1; ++i) {
    const Point start = a[i], along = a[(i + 1) % a.count()] - start;
    const double length_m = length(along);
    if (length_m == 0) continue;
    const Point outward = {along.y / length_m, -along.x / length_m};
    double least = HUGE_VAL;
    for (const Point p : b) least = std::fmin(least, dot(p - start, outward));
    if (least > widest.distance_m) widest = {least, outward};
  }
  return widest;
}

// Of convex cores, at least one with an area.
Separation of_core_points(const CorePoints& a, const CorePoints& b) {
  if (b.count() == 1) return core_to_point(a, b[0]);
  if (a.count() == 1) {
    const Separation s = core_to_point(b, a[0]);
    return {s.distance_m, reversed(s.normal)};
  }
  const Separation by_a = side_separation(a, b), by_b = side_separation(b, a);
  const Separation widest =
      by_a.distance_m >= by_b.distance_m ? by_a : Separation{by_b.distance_m, reversed(by_b.normal)};
  if (widest.distance_m <= 0) return widest;
  // Corners far behind along the separating direction cannot be nearest.
  double last_of_a = -HUGE_VAL, first_of_b = HUGE_VAL;
  for (const Point p : a) last_of_a = std::fmax(last_of_a, dot(p, widest.normal));
  for (const Point p : b) first_of_b = std::fmin(first_of_b, dot(p, widest.normal));
  constexpr double rounding_m = 1e-6;
  Separation nearest = {HUGE_VAL, {}};
  for (const Point corner : b) {
    if (dot(corner, widest.normal) - last_of_a > nearest.distance_m + rounding_m) continue;
    const Separation s = core_to_point(a, corner);
    if (s.distance_m < nearest.distance_m) nearest = s;
  }
  for (const Point corner : a) {
    if (first_of_b - dot(corner, widest.normal) > nearest.distance_m + rounding_m) continue;
    const Separation s = core_to_point(b, corner);
    if (s.distance_m < nearest.distance_m) nearest = {s.distance_m, reversed(s.normal)};
  }
  WAITPOINT_FAST_CHECK(nearest.distance_m < HUGE_VAL, "two disjoint cores have no nearest points");
  return nearest;
}

bool has_corners_of_its_own(const Outline& outline) { return outline.is_triangle || outline.polygon != nullptr; }

Separation of_cores(const Outline& a, const Outline& b) {
  if (has_corners_of_its_own(a) || has_corners_of_its_own(b)) return of_core_points(core_points(a), core_points(b));
  if (a.is_box) return b.is_box ? box_to_box(a, b) : box_to_point(a, b.centre);
  if (!b.is_box) return point_to_point(a.centre, b.centre);
  const Separation s = box_to_point(b, a.centre);
  return {s.distance_m, reversed(s.normal)};
}

}  // namespace

Separation separation(const Outline& a, const Outline& b) {
  const Separation cores = of_cores(a, b);
  WAITPOINT_FAST_CHECK(std::isfinite(cores.distance_m), "the distance of two outlines is not finite");
  return {cores.distance_m - a.radius_m - b.radius_m, cores.normal};
}

}  // namespace waitpoint::world
