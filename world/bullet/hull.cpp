// SPDX-License-Identifier: BSD-3-Clause
#include "world/bullet/hull.hpp"

#include <algorithm>

#include "core/exact_math.hpp"
#include "world/bullet/bullet_shapes.hpp"

namespace waitpoint::world {
namespace {

// The chord of an arc of length 1 and that turn. Turns of a step are below half a turn, except after an impact.
double chord_of_arc(double turn_rad) {
  const double half = 0.5 * turn_rad;
  return half == 0 ? 1 : std::max(exact::sin(half) / half, 0.5);
}

// To Bullet, an inertia of 0 is infinite.
btRigidBody::btRigidBodyConstructionInfo upright_body(const Shape& s, double mass_kg, btCollisionShape* shape) {
  return {mass_kg, nullptr, shape, {0, 0, inertia_kg_m2(s, mass_kg)}};
}

}  // namespace

Hull::Hull(const Shape& shape, double mass_kg, bool flies)
    : in_body_(shape),
      shape_(collision_shape(shape)),
      body_(upright_body(shape, mass_kg, shape_.get())),
      drive_(body_, flies) {
  body_.setFriction(flies ? 0 : hull_friction);
  body_.setActivationState(DISABLE_DEACTIVATION);
  body_.setAngularFactor({0, 0, 1});
  if (flies)
    body_.setFlags(body_.getFlags() | BT_DISABLE_WORLD_GRAVITY);
  else
    body_.setLinearFactor({1, 1, 0});
}

// In the world frame, for a body of that heading.
Point Hull::origin_from_centre(double heading_rad) const {
  const Point p = transform({0, 0, heading_rad}, in_body_.pose.position());
  return {-p.x, -p.y};
}

void Hull::place(const Pose& pose, double height_m) {
  const Pose centre = compose(pose, in_body_.pose);
  const double z_m = height_m + 0.5 * (in_body_.z_low_m + in_body_.z_high_m);
  placed_ = {centre.x, centre.y, z_m};
  heading_rad_ = placed_heading_rad_ = pose.heading;
  turned_rad_ = last_turn_rad_ = 0;
  touched_ = false;
  body_.setWorldTransform(btTransform(upright(centre.heading), placed_));
}

void Hull::set_velocity(const Velocity& velocity) {
  const auto [s, c] = exact::sincos(heading_rad_);
  const Point arm = origin_from_centre(heading_rad_);
  const double w = velocity.w_rad_s;
  body_.setLinearVelocity({c * velocity.v_m_s - s * velocity.side_m_s + w * arm.y,
                           s * velocity.v_m_s + c * velocity.side_m_s - w * arm.x, velocity.climb_m_s});
  body_.setAngularVelocity({0, 0, w});
}

void Hull::aim(const DriveAim& aim, double step_s) {
  const double middle_rad = heading_rad_ + 0.5 * aim.velocity.w_rad_s * step_s;
  const auto [s, c] = exact::sincos(middle_rad);
  DriveAim along_chord = aim;
  const double shortening = chord_of_arc(aim.velocity.w_rad_s * step_s);
  along_chord.velocity.v_m_s *= shortening;
  along_chord.velocity.side_m_s *= shortening;
  drive_.aim(along_chord, {c, s}, origin_from_centre(middle_rad));
}

void Hull::stepped(double step_s) {
  last_turn_rad_ = step_s * body_.getAngularVelocity().z();
  turned_rad_ += last_turn_rad_;
  heading_rad_ = placed_heading_rad_ + turned_rad_;
  btTransform at = body_.getWorldTransform();
  at.setBasis(upright(heading_rad_ + in_body_.pose.heading));
  body_.setWorldTransform(at);
}

BodyMotion Hull::motion() const {
  const btVector3 moved = body_.getWorldTransform().getOrigin() - placed_;
  const Point before = origin_from_centre(placed_heading_rad_), now = origin_from_centre(heading_rad_);
  const btVector3& v = body_.getLinearVelocity();
  const double w = body_.getAngularVelocity().z();
  // The velocity of the origin, at the heading in the middle of the step, as aimed by the drive.
  const double middle_rad = heading_rad_ - 0.5 * last_turn_rad_;
  const double shortening = chord_of_arc(last_turn_rad_);
  const Point arm = origin_from_centre(middle_rad);
  const Point velocity = {v.x() - w * arm.y, v.y() + w * arm.x};
  const auto [s, c] = exact::sincos(middle_rad);
  return {{moved.x() + (now.x - before.x), moved.y() + (now.y - before.y)},
          turned_rad_,
          moved.z(),
          {(c * velocity.x + s * velocity.y) / shortening, w, (c * velocity.y - s * velocity.x) / shortening, v.z()},
          touched_};
}

}  // namespace waitpoint::world
