// SPDX-License-Identifier: BSD-3-Clause
#include "world/bullet/bullet_shapes.hpp"

#include <algorithm>

#include "core/exact_math.hpp"

namespace waitpoint::world {
namespace {

static_assert(sizeof(btScalar) == sizeof(double), "Bullet is to compute in double precision");

// The margin by which Bullet rounds edges, except in contacts of two boxes.
constexpr double rounding_m = 0.002;

// Bullet rounds a convex hull's edges outwards, so its sides are moved inwards by the margin.
std::unique_ptr<btCollisionShape> prism(const Shape& shape) {
  const std::span<const ConvexPolygon::Side> sides = shape.polygon->sides();
  const btVector3 half = 0.5 * vector(size_of(shape));
  const double margin_m = std::min(rounding_m, 0.1 * half[half.minAxis()]);
  auto hull = std::make_unique<btConvexHullShape>();
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Point before = sides[(i + sides.size() - 1) % sides.size()].outward, after = sides[i].outward;
    // A bound for sharp corners.
    const double along = std::max(1 + dot(before, after), 0.1);
    const Point corner = sides[i].start - (margin_m / along) * (before + after);
    for (const double z : {-half.z() + margin_m, half.z() - margin_m}) hull->addPoint({corner.x, corner.y, z}, false);
  }
  hull->setMargin(margin_m);
  hull->recalcLocalAabb();
  return hull;
}

}  // namespace

btMatrix3x3 upright(double heading_rad) {
  const auto [s, c] = exact::sincos(heading_rad);
  return {c, -s, 0, s, c, 0, 0, 0, 1};
}

std::unique_ptr<btCollisionShape> collision_shape(Shape::Kind kind, SpaceVector size_m) {
  const btVector3 half = 0.5 * vector(size_m);
  std::unique_ptr<btConvexInternalShape> shape;
  if (kind == Shape::Kind::cylinder)
    shape = std::make_unique<btCylinderShapeZ>(half);
  else
    shape = std::make_unique<btBoxShape>(half);
  shape->setMargin(std::min(rounding_m, 0.1 * half[half.minAxis()]));
  return shape;
}

std::unique_ptr<btCollisionShape> collision_shape(const Shape& shape) {
  return shape.kind == Shape::Kind::prism ? prism(shape) : collision_shape(shape.kind, size_of(shape));
}

}  // namespace waitpoint::world
