// SPDX-License-Identifier: BSD-3-Clause
// A body on its base, between the commands that it gets and what became of its motion: the part of a world's step that
// is the same whatever finds the contacts.
#pragma once

#include <optional>

#include "world/planar/outline.hpp"
#include "world/vehicles/base.hpp"
#include "world/vehicles/odometer.hpp"

namespace waitpoint::world {

class Vehicle {
 public:
  /// At its start, at rest. The description must outlive it.
  Vehicle(const BodyDescription& description, std::uint64_t seed);

  const BodyDescription& description() const { return *description_; }
  const BodyState& state() const { return state_; }
  const OdometerReading& odometer() const { return odometer_.reading(); }
  /// Where it stands.
  const Outline& outline() const { return outline_; }
  /// Its shape in the body's frame, as high as it is now.
  Shape shape() const { return raised(description_->shape, state_.height_m); }

  /// Takes over a command that was given after `steps` steps.
  void command(Velocity velocity, std::uint64_t steps);
  /// Begins step number `step`, of that period: changes the velocity, and says how it would move at it.
  Arc latch(std::uint64_t step, Duration period);
  /// Ends it: the body has moved on that arc, unless a contact stopped it at a fraction of it.
  void publish(std::uint64_t step, Duration period, const Arc& arc, std::optional<double> stop);
  /// A person's hand puts it there, at rest.
  void put(const Pose& pose);

 private:
  const BodyDescription* description_;
  BodyState state_;
  Velocity wanted_;
  std::uint64_t commanded_at_ = 0;  // step
  double steering_rad_ = 0;
  Outline outline_;  // at state_.pose
  Odometer odometer_;
};

}  // namespace waitpoint::world
