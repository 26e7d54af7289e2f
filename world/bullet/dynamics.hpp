// SPDX-License-Identifier: BSD-3-Clause
// Rigid bodies under forces, by Bullet.
//
//   floor      a plane at height 0, in contact with loose solids and aerial bodies only
//   standing   fixed upright solids and meshes; of meshes the parts more than a millimetre above the floor
//   hull       a robot: always upright, driven by motors; supported by its wheels under any load, or by its thrust
//   loose      a box or cylinder with a mass, free in space: it slides, turns, falls, tips over
//
// The friction of a contact is the product of the two coefficients; restitution is 0. One thread, steps of the caller's
// length, a fixed number of iterations, bodies in the order of their addition: the same calls give the same bits with
// the same build of Bullet.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "world/bullet/drive_aim.hpp"
#include "world/bullet/loose_solid.hpp"
#include "world/triangle_mesh.hpp"
#include "world/vehicles/vehicle.hpp"

namespace waitpoint::world {

class Dynamics {
 public:
  explicit Dynamics(std::span<const Shape> standing, std::span<const MeshObstacle> meshes = {});
  ~Dynamics();

  /// Hulls and loose solids are numbered from 0, each in the order of addition. A hull's shape is given in the body's
  /// frame; it must be placed before the first step.
  void add_hull(const Shape& shape, double mass_kg, bool flies);
  void add_loose(const LooseSolid& solid);

  /// Sets the pose and height of a body, which keeps its velocity.
  void place_hull(std::uint32_t hull, const Pose& body, double height_m);
  /// Sets the velocity of a body, which keeps its pose.
  void set_velocity(std::uint32_t hull, const Velocity& velocity);
  /// Sets the target of its drive in the next step, of length `step_s`.
  void aim(std::uint32_t hull, const DriveAim& aim, double step_s);
  /// Applies a force at the centre, in the next step.
  void push_hull(std::uint32_t hull, Point force_n);
  void push_loose(std::uint32_t loose, Point force_n);

  void step(double step_s);

  /// The body's motion since it was placed.
  BodyMotion motion(std::uint32_t hull) const;
  /// The current state of a loose solid.
  const LooseSolid& loose(std::uint32_t number) const;
  /// True if it may have moved in the last step: a solid at rest sleeps until another comes near.
  bool awake(std::uint32_t loose) const;
  bool any_awake() const;

 private:
  struct Bodies;
  std::unique_ptr<Bodies> bodies_;
};

}  // namespace waitpoint::world
