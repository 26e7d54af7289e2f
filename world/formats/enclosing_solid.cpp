// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/enclosing_solid.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/exact_math.hpp"
#include "world/formats/upright.hpp"
#include "world/planar/outline.hpp"

namespace waitpoint::world {
namespace {

// The sides of a polygon about a disc; and the ratio of areas below which a prism replaces a box or a cylinder.
constexpr int round_sides = 24;
constexpr double much_tighter = 0.9;

double area_m2(const ConvexPolygon& polygon) {
  const std::span<const ConvexPolygon::Side> sides = polygon.sides();
  double twice_m2 = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) twice_m2 += cross(sides[i].start, sides[(i + 1) % sides.size()].start);
  return 0.5 * twice_m2;
}

// The convex hull of the projection; cylinders as polygons.
std::optional<PlacedPolygon> hull_around(std::span<const Shape> solids) {
  std::vector<Point> corners;
  for (const Shape& solid : solids) {
    const Outline outline = outline_of(solid);
    if (outline.radius_m == 0) {
      for (const Point p : core_points(outline)) corners.push_back(p);
      continue;
    }
    const double corner_m = outline.radius_m / exact::cos(exact::pi / round_sides);
    for (int i = 0; i < round_sides; ++i) {
      const auto [s, c] = exact::sincos(2 * exact::pi * i / round_sides);
      corners.push_back(outline.centre + corner_m * Point{c, s});
    }
  }
  return hull_of(std::move(corners), thickness_least_m);
}

}  // namespace

EnclosingSolid enclosing_solid(std::span<const Shape> solids) {
  Bounds bounds = bounds_of(outline_of(solids[0]));
  double radius_m = 0;
  Shape all;
  all.z_low_m = solids[0].z_low_m;
  all.z_high_m = solids[0].z_high_m;
  for (const Shape& solid : solids) {
    const Outline outline = outline_of(solid);
    const Bounds own = bounds_of(outline);
    bounds = {{std::min(bounds.low.x, own.low.x), std::min(bounds.low.y, own.low.y)},
              {std::max(bounds.high.x, own.high.x), std::max(bounds.high.y, own.high.y)}};
    for (const Point p : core_points(outline)) radius_m = std::max(radius_m, exact::hypot(p.x, p.y) + outline.radius_m);
    all.z_low_m = std::min(all.z_low_m, solid.z_low_m);
    all.z_high_m = std::max(all.z_high_m, solid.z_high_m);
  }
  all.length_m = bounds.high.x - bounds.low.x;
  all.width_m = bounds.high.y - bounds.low.y;
  const double round_m2 = exact::pi * radius_m * radius_m, box_m2 = all.length_m * all.width_m;
  if (const std::optional<PlacedPolygon> hull = hull_around(solids);
      hull && area_m2(*hull->polygon) < much_tighter * std::min(round_m2, box_m2)) {
    all.kind = Shape::Kind::prism;
    all.pose = {hull->origin.x, hull->origin.y, 0};
    all.length_m = 2 * hull->polygon->half_size().x;
    all.width_m = 2 * hull->polygon->half_size().y;
    all.polygon = hull->polygon;
    return {all, "the upright prism over the convex outline of them"};
  }
  if (round_m2 <= box_m2) {
    all.kind = Shape::Kind::cylinder;
    all.radius_m = radius_m;
    return {all, "the upright cylinder about them"};
  }
  all.pose = {0.5 * (bounds.low.x + bounds.high.x), 0.5 * (bounds.low.y + bounds.high.y), 0};
  return {all, "the upright box about them"};
}

Shape enclosing_box(std::span<const SpaceVector> points, const SpacePose& pose) {
  SpaceVector low = points[0], high = points[0];
  for (const SpaceVector& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  SpacePose middle = pose;
  middle.position = pose.position + pose.turned(0.5 * (low + high));
  const SpaceVector size = high + -1 * low;
  return upright_box(middle, {std::max(size.x, thickness_least_m), std::max(size.y, thickness_least_m),
                              std::max(size.z, thickness_least_m)})
      .shape;
}

}  // namespace waitpoint::world
