// SPDX-License-Identifier: BSD-3-Clause
// Something with a mass that lies, stands or tumbles in space, and how it looks from a world of upright shapes.
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

/// As the shape of that mass stands upright, at rest; for a prism the box about it.
LooseSolid loose_solid(const Shape& shape, double mass_kg, double friction);

/// The upright shape that it is, or while it tips the one about it.
Shape upright_shape(const LooseSolid& solid);

/// Its extents along its own axes.
SpaceVector size_of(const Shape& shape);
/// Of a shape about the vertical through its middle.
double inertia_kg_m2(const Shape& shape, double mass_kg);

}  // namespace waitpoint::world
