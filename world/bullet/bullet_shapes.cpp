// SPDX-License-Identifier: BSD-3-Clause
#include "world/bullet/bullet_shapes.hpp"

#include <algorithm>

#include "core/exact_math.hpp"

namespace waitpoint::world {
namespace {

static_assert(sizeof(btScalar) == sizeof(double), "Bullet is to compute in double precision");

// Bullet rounds the edges of what it finds contacts of, other than of two boxes, by this much.
constexpr double rounding_m = 0.002;

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

}  // namespace waitpoint::world
