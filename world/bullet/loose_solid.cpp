// SPDX-License-Identifier: BSD-3-Clause
#include "world/bullet/loose_solid.hpp"

#include "world/formats/upright.hpp"

namespace waitpoint::world {

SpaceVector size_of(const Shape& shape) {
  const double height = shape.z_high_m - shape.z_low_m;
  if (shape.kind == Shape::Kind::cylinder) return {2 * shape.radius_m, 2 * shape.radius_m, height};
  return {shape.length_m, shape.width_m, height};
}

LooseSolid loose_solid(const Shape& shape, double mass_kg, double friction) {
  const Shape::Kind kind = shape.kind == Shape::Kind::cylinder ? Shape::Kind::cylinder : Shape::Kind::box;
  LooseSolid solid{kind, size_of(shape), mass_kg, friction, {}, {}, {}};
  const auto [s, c] = exact::sincos(shape.pose.heading);
  solid.pose = {{shape.pose.x, shape.pose.y, 0.5 * (shape.z_low_m + shape.z_high_m)},
                {{{c, s, 0}, {-s, c, 0}, {0, 0, 1}}}};
  return solid;
}

double inertia_kg_m2(const Shape& shape, double mass_kg) {
  if (shape.kind == Shape::Kind::cylinder) return 0.5 * mass_kg * shape.radius_m * shape.radius_m;
  if (shape.kind == Shape::Kind::prism) return mass_kg * shape.polygon->mean_square_m2();
  return mass_kg / 12 * (shape.length_m * shape.length_m + shape.width_m * shape.width_m);
}

Shape upright_shape(const LooseSolid& solid) {
  if (solid.kind == Shape::Kind::box) return upright_box(solid.pose, solid.size_m).shape;
  return upright_cylinder(solid.pose, 0.5 * solid.size_m.x, solid.size_m.z).shape;
}

}  // namespace waitpoint::world
