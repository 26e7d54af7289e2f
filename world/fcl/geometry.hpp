// SPDX-License-Identifier: BSD-3-Clause
// Upright shapes as FCL has them.
#pragma once

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>

#include <memory>

#include "world/planar/outline.hpp"

namespace waitpoint::world {

inline std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Shape& shape) {
  const double height = shape.z_high_m - shape.z_low_m;
  if (shape.kind == Shape::Kind::cylinder) return std::make_shared<fcl::Cylinderd>(shape.radius_m, height);
  return std::make_shared<fcl::Boxd>(shape.length_m, shape.width_m, height);
}

/// Where it is, its outline being that.
inline fcl::Transform3d transform_of(const Outline& outline, double z_low_m, double z_high_m) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  const double c = outline.axis_cos, s = outline.axis_sin;
  transform.linear() << c, -s, 0, s, c, 0, 0, 0, 1;
  transform.translation() << outline.centre.x, outline.centre.y, 0.5 * (z_low_m + z_high_m);
  return transform;
}

}  // namespace waitpoint::world
