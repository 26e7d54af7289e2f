// SPDX-License-Identifier: BSD-3-Clause
// Upright shapes as FCL geometry.
#pragma once

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>

#include <memory>
#include <span>
#include <vector>

#include "world/planar/outline.hpp"

namespace waitpoint::world {

/// A prism about its centre. Corners: those of the lower face, then those of the upper one.
inline std::shared_ptr<fcl::CollisionGeometryd> prism_of(std::span<const ConvexPolygon::Side> sides, double height_m) {
  const auto n = static_cast<int>(sides.size());
  auto corners = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const double z : {-0.5 * height_m, 0.5 * height_m})
    for (const ConvexPolygon::Side& side : sides) corners->emplace_back(side.start.x, side.start.y, z);
  // Each face: the count and the indices of its corners, counter-clockwise as seen from outside.
  auto faces = std::make_shared<std::vector<int>>();
  faces->push_back(n);
  for (int i = n; i-- > 0;) faces->push_back(i);
  faces->push_back(n);
  for (int i = 0; i < n; ++i) faces->push_back(n + i);
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    faces->insert(faces->end(), {4, i, next, n + next, n + i});
  }
  return std::make_shared<fcl::Convexd>(corners, n + 2, faces);
}

inline std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Shape& shape) {
  const double height = shape.z_high_m - shape.z_low_m;
  if (shape.kind == Shape::Kind::cylinder) return std::make_shared<fcl::Cylinderd>(shape.radius_m, height);
  if (shape.kind == Shape::Kind::prism) return prism_of(shape.polygon->sides(), height);
  return std::make_shared<fcl::Boxd>(shape.length_m, shape.width_m, height);
}

/// The pose of a solid with that outline.
inline fcl::Transform3d transform_of(const Outline& outline, double z_low_m, double z_high_m) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  const double c = outline.axis_cos, s = outline.axis_sin;
  transform.linear() << c, -s, 0, s, c, 0, 0, 0, 1;
  transform.translation() << outline.centre.x, outline.centre.y, 0.5 * (z_low_m + z_high_m);
  return transform;
}

}  // namespace waitpoint::world
