// SPDX-License-Identifier: BSD-3-Clause
// Our shapes and vectors as Bullet's.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>

#include "world/bullet/loose_solid.hpp"

namespace waitpoint::world {

inline btVector3 vector(SpaceVector v) { return {v.x, v.y, v.z}; }
inline SpaceVector space_vector(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// The axes of what stands upright.
btMatrix3x3 upright(double heading_rad);

/// Of these extents along its own axes, about its middle: a box or a cylinder.
std::unique_ptr<btCollisionShape> collision_shape(Shape::Kind kind, SpaceVector size_m);
/// Of what stands upright, about its middle.
std::unique_ptr<btCollisionShape> collision_shape(const Shape& shape);

}  // namespace waitpoint::world
