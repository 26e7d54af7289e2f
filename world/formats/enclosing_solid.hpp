// SPDX-License-Identifier: BSD-3-Clause
// One upright solid about several: the box, the cylinder about the origin, or the prism over the convex outline.
#pragma once

#include <span>
#include <string_view>

#include "world/description.hpp"
#include "world/space_pose.hpp"

namespace waitpoint::world {

/// The least thickness of a solid.
inline constexpr double thickness_least_m = 1e-4;

struct EnclosingSolid {
  Shape shape;
  std::string_view name;  ///< "the upright box about them", for messages
};

/// The smaller of box and cylinder, or the prism if it is smaller than both by a tenth or more; round parts then have
/// 24 sides. At least one solid.
EnclosingSolid enclosing_solid(std::span<const Shape> solids);

/// The upright box, aligned with the axes of `pose`, about points given in its frame; at least 0.1 mm in each
/// direction. At least one point.
Shape enclosing_box(std::span<const SpaceVector> points, const SpacePose& pose);

}  // namespace waitpoint::world
