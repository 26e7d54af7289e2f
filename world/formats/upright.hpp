// SPDX-License-Identifier: BSD-3-Clause
// Solids of space as the upright shapes of this world: exact where one of a box's axes, or the cylinder's own, is
// vertical to within tilt_max_rad; else an upright shape that the solid just fits into.
//
//   a tilted box        the box of its extents along and across the edge that is longest seen from above, and upwards
//   a tilted cylinder   the box of its extents along and across its axis as seen from above, and upwards
//   a sphere            the cylinder about it
//   any points          the prism over their convex hull as seen from above, as high as they are
#pragma once

#include <optional>
#include <span>

#include "world/description.hpp"
#include "world/space_pose.hpp"

namespace waitpoint::world {

/// 0.1 mm a metre: what is saved after a simulation has settled is a little crooked.
inline constexpr double tilt_max_rad = 1e-4;

struct UprightSolid {
  Shape shape;
  bool exact = true;  ///< whether the shape is the solid
};

/// A box about `pose`, of that length along each of its axes.
UprightSolid upright_box(const SpacePose& pose, SpaceVector size_m);
/// A cylinder about `pose`, along its third axis.
UprightSolid upright_cylinder(const SpacePose& pose, double radius_m, double length_m);
UprightSolid upright_sphere(const SpacePose& pose, double radius_m);
/// About one point at least, with a heading of 0; none where they are thinner than 0.1 mm, seen from above or upwards.
std::optional<Shape> upright_hull(std::span<const SpaceVector> points);

}  // namespace waitpoint::world
