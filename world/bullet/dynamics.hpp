// SPDX-License-Identifier: BSD-3-Clause
// Rigid bodies under forces, by Bullet.
//
//   floor      a plane at height 0, which only loose solids and what flies meet
//   standing   upright solids and meshes that nothing moves; of meshes what is above the floor by more than a
//   millimetre hull       a robot: always upright, driven by motors; borne by its wheels whatever stands on it, or by
//   its thrust loose      a box or cylinder with a mass, free in space: it slides, turns, falls, tips over
//
// The friction of two is the product of their coefficients; nothing bounces. One thread, steps of the caller's length,
// a fixed number of iterations, everything in the order in which it was added: the same calls give the same bits from
// one build of Bullet.
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

  /// Hulls and loose solids are numbered from 0, each in the order they are added. A hull's shape is given in the
  /// body's frame; it must be placed.
  void add_hull(const Shape& shape, double mass_kg, bool flies);
  void add_loose(const LooseSolid& solid);

  /// Puts the body there, so high. It keeps its velocity.
  void place_hull(std::uint32_t hull, const Pose& body, double height_m);
  /// Gives it that velocity, where it stands.
  void set_velocity(std::uint32_t hull, const Velocity& velocity);
  /// What its drive is to reach in the next step, of that length.
  void aim(std::uint32_t hull, const DriveAim& aim, double step_s);
  /// Forces at the centre, in the next step.
  void push_hull(std::uint32_t hull, Point force_n);
  void push_loose(std::uint32_t loose, Point force_n);

  void step(double step_s);

  /// What became of the body since it was placed; touched by anything but the floor.
  BodyMotion motion(std::uint32_t hull) const;
  /// As added, with what changed since.
  const LooseSolid& loose(std::uint32_t number) const;
  /// Whether it may have moved in the last step: what has come to rest sleeps, until something comes near.
  bool awake(std::uint32_t loose) const;
  bool any_awake() const;

 private:
  struct Bodies;
  std::unique_ptr<Bodies> bodies_;
};

}  // namespace waitpoint::world
