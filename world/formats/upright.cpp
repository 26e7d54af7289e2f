// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/upright.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "core/exact_math.hpp"

namespace waitpoint::world {
namespace {

double level_length(SpaceVector v) { return exact::hypot(v.x, v.y); }
constexpr double thin_m = 1e-4;
bool is_vertical(SpaceVector axis) { return level_length(axis) < tilt_max_rad; }

// A shape with centre and heights; its heading is that of the projection of `along`.
Shape shape_at(const SpacePose& pose, SpaceVector along, double half_height_m) {
  Shape shape;
  shape.pose = {pose.position.x, pose.position.y, exact::atan2(along.y, along.x)};
  shape.z_low_m = pose.position.z - half_height_m;
  shape.z_high_m = pose.position.z + half_height_m;
  return shape;
}

// The extent of a disc of radius 1, normal to the axis, along a direction with that component along the axis.
double disc_reach(double component) { return std::sqrt(std::fmax(0, 1 - component * component)); }

}  // namespace

UprightSolid upright_box(const SpacePose& pose, SpaceVector size_m) {
  const std::array<double, 3> size = {size_m.x, size_m.y, size_m.z};
  for (std::size_t up = 3; up-- > 0;) {
    if (!is_vertical(pose.axes[up])) continue;
    const std::size_t along = (up + 1) % 3, across = (up + 2) % 3;
    Shape shape = shape_at(pose, pose.axes[along], 0.5 * size[up]);
    shape.length_m = size[along];
    shape.width_m = size[across];
    return {shape, true};
  }
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (size[i] * level_length(pose.axes[i]) > size[longest] * level_length(pose.axes[longest])) longest = i;
  const SpaceVector direction = (1 / level_length(pose.axes[longest])) * pose.axes[longest];
  double along = 0, across = 0, up = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const SpaceVector& axis = pose.axes[i];
    along += size[i] * std::fabs(axis.x * direction.x + axis.y * direction.y);
    across += size[i] * std::fabs(axis.y * direction.x - axis.x * direction.y);
    up += size[i] * std::fabs(axis.z);
  }
  Shape shape = shape_at(pose, direction, 0.5 * up);
  shape.length_m = along;
  shape.width_m = across;
  return {shape, false};
}

UprightSolid upright_cylinder(const SpacePose& pose, double radius_m, double length_m) {
  const SpaceVector& axis = pose.axes[2];
  if (is_vertical(axis)) {
    Shape shape = shape_at(pose, pose.axes[0], 0.5 * length_m);
    shape.kind = Shape::Kind::cylinder;
    shape.radius_m = radius_m;
    return {shape, true};
  }
  const double level = level_length(axis);
  Shape shape = shape_at(pose, axis, 0.5 * length_m * std::fabs(axis.z) + radius_m * disc_reach(axis.z));
  shape.length_m = length_m * level + 2 * radius_m * disc_reach(level);
  shape.width_m = 2 * radius_m;
  return {shape, false};
}

UprightSolid upright_sphere(const SpacePose& pose, double radius_m) {
  Shape shape = shape_at(pose, pose.axes[0], radius_m);
  shape.kind = Shape::Kind::cylinder;
  shape.radius_m = radius_m;
  return {shape, false};
}

std::optional<Shape> upright_hull(std::span<const SpaceVector> points) {
  std::vector<Point> from_above;
  Shape shape;
  shape.kind = Shape::Kind::prism;
  shape.z_low_m = shape.z_high_m = points.front().z;
  for (const SpaceVector& p : points) {
    from_above.push_back({p.x, p.y});
    shape.z_low_m = std::fmin(shape.z_low_m, p.z);
    shape.z_high_m = std::fmax(shape.z_high_m, p.z);
  }
  const std::optional<PlacedPolygon> hull = hull_of(std::move(from_above), thin_m);
  if (!hull || shape.z_high_m - shape.z_low_m < thin_m) return std::nullopt;
  shape.pose = {hull->origin.x, hull->origin.y, 0};
  shape.length_m = 2 * hull->polygon->half_size().x;
  shape.width_m = 2 * hull->polygon->half_size().y;
  shape.polygon = hull->polygon;
  return shape;
}

}  // namespace waitpoint::world
