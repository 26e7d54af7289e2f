// SPDX-License-Identifier: BSD-3-Clause
// hit_distance(), inline, for callers on hot paths. Not for sources compiled for one instruction set (see
// world/slice/vectors.hpp).
#pragma once

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "world/planar/ray.hpp"

namespace waitpoint::world {

inline double hit_box(const Outline& box, const Ray& ray) {
  const Point o = box.local(ray.origin);
  const Point d = {box.axis_cos * ray.direction.x + box.axis_sin * ray.direction.y,
                   box.axis_cos * ray.direction.y - box.axis_sin * ray.direction.x};
  const double half_x = box.half_length_m + seal_m, half_y = box.half_width_m + seal_m;
  double enter = 0, leave = no_hit;
  if (d.x != 0) {
    const double far_side = std::copysign(half_x, d.x);
    enter = std::max(enter, (-far_side - o.x) / d.x);
    leave = std::min(leave, (far_side - o.x) / d.x);
  } else if (std::fabs(o.x) > half_x) {
    return no_hit;
  }
  if (d.y != 0) {
    const double far_side = std::copysign(half_y, d.y);
    enter = std::max(enter, (-far_side - o.y) / d.y);
    leave = std::min(leave, (far_side - o.y) / d.y);
  } else if (std::fabs(o.y) > half_y) {
    return no_hit;
  }
  return enter <= leave ? enter : no_hit;
}

inline double hit_disc(const Outline& disc, const Ray& ray) {
  const Point to_centre = disc.centre - ray.origin;
  const double square = disc.radius_m * disc.radius_m;
  if (dot(to_centre, to_centre) <= square) return 0;
  const double along = dot(to_centre, ray.direction);
  if (along <= 0) return no_hit;
  // A cross product, not a difference of squares: that would lose its digits far away.
  const double offset = cross(to_centre, ray.direction);
  const double rest = square - offset * offset;
  if (rest < 0) return no_hit;
  return std::max(along - std::sqrt(rest), 0.0);
}

inline double hit_polygon(const Outline& outline, const Ray& ray) {
  const Point o = outline.local(ray.origin);
  const Point d = {outline.axis_cos * ray.direction.x + outline.axis_sin * ray.direction.y,
                   outline.axis_cos * ray.direction.y - outline.axis_sin * ray.direction.x};
  double enter = 0, leave = no_hit;
  for (const ConvexPolygon::Side& side : outline.polygon->sides()) {
    const double within = side.beyond_m + seal_m - dot(side.outward, o), outwards = dot(side.outward, d);
    if (outwards < 0) {
      enter = std::max(enter, within / outwards);
    } else if (outwards > 0) {
      leave = std::min(leave, within / outwards);
    } else if (within < 0) {
      return no_hit;
    }
  }
  return enter <= leave ? enter : no_hit;
}

inline double hit(const Outline& outline, const Ray& ray) {
  WAITPOINT_FAST_CHECK(!outline.is_triangle, "a ray is tested against a triangle, which has no hit");
  if (outline.is_box) return hit_box(outline, ray);
  return outline.polygon != nullptr ? hit_polygon(outline, ray) : hit_disc(outline, ray);
}

}  // namespace waitpoint::world
