// SPDX-License-Identifier: BSD-3-Clause
#include "world/planar/outline.hpp"

#include <cmath>

namespace waitpoint::world {
namespace {

Outline outline_at(const Shape& shape, Point centre, double heading) {
  Outline outline;
  outline.centre = centre;
  if (shape.kind == Shape::Kind::cylinder) {
    outline.radius_m = shape.radius_m;
    return outline;
  }
  const auto [s, c] = exact::sincos(heading);
  outline.axis_cos = c;
  outline.axis_sin = s;
  outline.half_length_m = 0.5 * shape.length_m;
  outline.half_width_m = 0.5 * shape.width_m;
  outline.is_box = true;
  return outline;
}

}  // namespace

Outline outline_of(const Shape& shape) { return outline_at(shape, shape.pose.position(), shape.pose.heading); }

Outline outline_of(const Shape& shape, const Pose& body) {
  return outline_at(shape, transform(body, shape.pose.position()), body.heading + shape.pose.heading);
}

CorePoints core_points(const Outline& outline) {
  if (!outline.is_box) return {{outline.centre}, 1};
  const Point along = outline.outward({outline.half_length_m, 0}), across = outline.outward({0, outline.half_width_m});
  const Point front = outline.centre + along, back = outline.centre - along;
  return {{front + across, back + across, back - across, front - across}, 4};
}

Bounds bounds_of(const Outline& outline) {
  const double c = std::fabs(outline.axis_cos), s = std::fabs(outline.axis_sin);
  const Point half = {c * outline.half_length_m + s * outline.half_width_m + outline.radius_m,
                      s * outline.half_length_m + c * outline.half_width_m + outline.radius_m};
  return {outline.centre - half, outline.centre + half};
}

}  // namespace waitpoint::world
