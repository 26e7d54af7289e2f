// SPDX-License-Identifier: BSD-3-Clause
// A solid with a mass, free in space, and its representation in a world of upright shapes.
#pragma once

#include "world/description.hpp"
#include "world/space_pose.hpp"

namespace waitpoint::world {

/// A loose solid: a box, or a cylinder about its third axis.
struct LooseSolid {
  Shape::Kind kind = Shape::Kind::box;
  SpaceVector size_m;
  double mass_kg = 1, friction = 0.5;
  SpacePose pose;  ///< of its centre
  SpaceVector velocity_m_s, spin_rad_s;
};

/// The upright shape as a loose solid at rest; a prism becomes its bounding box.
LooseSolid loose_solid(const Shape& shape, double mass_kg, double friction);

/// The solid as an upright shape; its upright bounding shape while it is tilted.
Shape upright_shape(const LooseSolid& solid);

/// A shape's extents along its own axes.
SpaceVector size_of(const Shape& shape);
/// A shape's moment of inertia about the vertical through its centre.
double inertia_kg_m2(const Shape& shape, double mass_kg);

}  // namespace waitpoint::world
