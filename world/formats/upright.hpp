// SPDX-License-Identifier: BSD-3-Clause
// Solids in space as upright shapes: exact if one of a box's axes, or the cylinder's own, is vertical to within
// tilt_max_rad; else an upright bounding shape.
//
//   a tilted box        the box of its extents along and across its longest edge in the projection, and upwards
//   a tilted cylinder   the box of its extents along and across its projected axis, and upwards
//   a sphere            the cylinder about it
//   any points          the prism over the convex hull of their projections, with their extent upwards
#pragma once

#include <optional>
#include <span>

#include "world/description.hpp"
#include "world/space_pose.hpp"

namespace waitpoint::world {

/// 0.1 mm per metre: poses saved from a settled simulation are slightly tilted.
inline constexpr double tilt_max_rad = 1e-4;

struct UprightSolid {
  Shape shape;
  bool exact = true;  ///< the shape equals the solid
};

/// A box centred at `pose`, of that size along its axes.
UprightSolid upright_box(const SpacePose& pose, SpaceVector size_m);
/// A cylinder about `pose`, along its third axis.
UprightSolid upright_cylinder(const SpacePose& pose, double radius_m, double length_m);
UprightSolid upright_sphere(const SpacePose& pose, double radius_m);
/// Of at least one point, with heading 0; none if the points are thinner than 0.1 mm in the projection or upwards.
std::optional<Shape> upright_hull(std::span<const SpaceVector> points);

}  // namespace waitpoint::world
