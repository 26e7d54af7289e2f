// SPDX-License-Identifier: BSD-3-Clause
// A robot as a rigid body of Bullet: upright, rotating about the vertical only, with a drive.
//
// Bullet moves the centre of its shape; poses and velocities here are those of the body's origin, as everywhere else.
// The heading is accumulated from its turns, not read back from Bullet's matrix.
#pragma once

#include <memory>

#include "world/bullet/drive.hpp"
#include "world/vehicles/vehicle.hpp"

namespace waitpoint::world {

/// The friction coefficient of hulls; that of floor and fixed solids is 1.
inline constexpr double hull_friction = 0.5;

class Hull {
 public:
  /// The shape is in the body's frame; it must be placed before it moves.
  Hull(const Shape& shape, double mass_kg, bool flies);

  btRigidBody& body() { return body_; }
  Drive& drive() { return drive_; }

  /// See Dynamics.
  void place(const Pose& pose, double height_m);
  void set_velocity(const Velocity& velocity);
  void aim(const DriveAim& aim, double step_s);
  BodyMotion motion() const;

  /// To be called after each step of Bullet.
  void stepped(double step_s);
  void touch() { touched_ = true; }

 private:
  Point origin_from_centre(double heading_rad) const;

  Shape in_body_;
  std::unique_ptr<btCollisionShape> shape_;
  btRigidBody body_;
  Drive drive_;
  double heading_rad_ = 0;
  btVector3 placed_ = {0, 0, 0};  // the centre
  double placed_heading_rad_ = 0, turned_rad_ = 0, last_turn_rad_ = 0;
  bool touched_ = false;
};

}  // namespace waitpoint::world
