// SPDX-License-Identifier: BSD-3-Clause
#include "world/planar/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/error.hpp"

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
  outline.is_box = shape.kind == Shape::Kind::box;
  WAITPOINT_FAST_CHECK(outline.half_length_m >= 0 && outline.half_width_m >= 0, "a shape has a negative size");
  if (shape.kind != Shape::Kind::prism) return outline;
  outline.polygon = shape.polygon.get();
  WAITPOINT_CHECK(outline.polygon != nullptr, "a prism has no polygon");
  return outline;
}

}  // namespace

std::vector<std::shared_ptr<const ConvexPolygon>> polygons_of(std::span<const Shape> shapes) {
  std::vector<std::shared_ptr<const ConvexPolygon>> polygons;
  for (const Shape& shape : shapes)
    if (shape.polygon) polygons.push_back(shape.polygon);
  return polygons;
}

Outline outline_of(const Shape& shape) { return outline_at(shape, shape.pose.position(), shape.pose.heading); }

Outline outline_of(const Shape& shape, const Pose& body) {
  return outline_at(shape, transform(body, shape.pose.position()), body.heading + shape.pose.heading);
}

Outline segment_outline(Point a, Point b) {
  const Point along = b - a;
  const double length_m = length(along);
  Outline outline;
  outline.centre = a + 0.5 * along;
  if (length_m > 0) {
    outline.axis_cos = along.x / length_m;
    outline.axis_sin = along.y / length_m;
  }
  outline.half_length_m = 0.5 * length_m;
  outline.is_box = true;
  return outline;
}

Outline triangle_outline(Point a, Point b, Point c) {
  const std::array<Point, 3> p = {a, b, c};
  std::size_t from = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (length(p[(i + 1) % 3] - p[i]) > length(p[(from + 1) % 3] - p[from])) from = i;
  Point start = p[from], end = p[(from + 1) % 3];
  const Point apex = p[(from + 2) % 3];
  if (cross(end - start, apex - start) < 0) std::swap(start, end);
  Outline outline = segment_outline(start, end);
  // A shorter side has no direction left after rounding, and so no normal.
  constexpr double one_point_m = 1e-9;
  if (std::min(length(apex - start), length(apex - end)) < one_point_m) return outline;
  const Point top = outline.local(apex);
  if (!(top.y > 0)) return outline;
  outline.is_box = false;
  outline.is_triangle = true;
  outline.apex_m = top.x;
  outline.half_width_m = 0.5 * top.y;
  outline.centre = outline.centre + outline.outward({0, outline.half_width_m});
  return outline;
}

CorePoints core_points(const Outline& outline) {
  if (outline.is_triangle) {
    const double l = outline.half_length_m, w = outline.half_width_m;
    const auto at = [&](Point p) { return outline.centre + outline.outward(p); };
    return {{at({outline.apex_m, w}), at({-l, -w}), at({l, -w})}, 3};
  }
  if (outline.polygon != nullptr) return CorePoints(outline);
  if (!outline.is_box) return {{outline.centre}, 1};
  const Point along = outline.outward({outline.half_length_m, 0}), across = outline.outward({0, outline.half_width_m});
  const Point front = outline.centre + along, back = outline.centre - along;
  return {{front + across, back + across, back - across, front - across}, 4};
}

Bounds bounds_of(const Outline& outline) {
  if (outline.is_triangle || outline.polygon != nullptr) {
    const CorePoints corners = core_points(outline);
    Bounds bounds = {corners[0], corners[0]};
    for (const Point p : corners) {
      bounds = {{std::min(bounds.low.x, p.x), std::min(bounds.low.y, p.y)},
                {std::max(bounds.high.x, p.x), std::max(bounds.high.y, p.y)}};
    }
    return bounds;
  }
  WAITPOINT_FAST_CHECK(outline.radius_m >= 0, "an outline has a negative radius");
  const double c = std::fabs(outline.axis_cos), s = std::fabs(outline.axis_sin);
  const Point half = {c * outline.half_length_m + s * outline.half_width_m + outline.radius_m,
                      s * outline.half_length_m + c * outline.half_width_m + outline.radius_m};
  return {outline.centre - half, outline.centre + half};
}

}  // namespace waitpoint::world
