// SPDX-License-Identifier: BSD-3-Clause
// Conversion of shapes and vectors to Bullet's types.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>

#include "world/bullet/loose_solid.hpp"

namespace waitpoint::world {

inline btVector3 vector(SpaceVector v) { return {v.x, v.y, v.z}; }
inline SpaceVector space_vector(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// The axes of an upright solid.
btMatrix3x3 upright(double heading_rad);

/// A box or a cylinder of these extents along its own axes, about its centre.
std::unique_ptr<btCollisionShape> collision_shape(Shape::Kind kind, SpaceVector size_m);
/// An upright solid, about its centre.
std::unique_ptr<btCollisionShape> collision_shape(const Shape& shape);

}  // namespace waitpoint::world
