// SPDX-License-Identifier: BSD-3-Clause
// A body on its base, between the commands that it gets and what became of its motion: the part of a world's step that
// is the same whatever finds the contacts.
#pragma once

#include <optional>

#include "world/planar/outline.hpp"
#include "world/vehicles/base.hpp"
#include "world/vehicles/battery.hpp"
#include "world/vehicles/odometer.hpp"

namespace waitpoint::world {

/// What became of a body's step where forces decide.
struct BodyMotion {
  Point moved;  ///< in the world's frame
  double turned_rad = 0, climbed_m = 0;
  Velocity velocity;     ///< at the end, in the body's frame
  bool touched = false;  ///< whether something pressed against it
};

class Vehicle {
 public:
  /// At its start, at rest. The description must outlive it.
  Vehicle(const BodyDescription& description, std::uint64_t seed);

  const BodyDescription& description() const { return *description_; }
  const BodyState& state() const { return state_; }
  const OdometerReading& odometer() const { return odometer_.reading(); }
  /// Adds what its state and a command touch.
  void add_to(WorkingSet& set) const { set.add_between(this, &motion_); }
  /// So long after the start.
  BatteryState battery(double elapsed_s) const;
  /// Where it stands.
  const Outline& outline() const { return outline_; }
  /// Its shape in the body's frame, as high as it is now.
  Shape shape() const { return raised(description_->shape, state_.height_m); }

  /// Takes over a command that was given after `steps` steps.
  void command(Velocity velocity, std::uint64_t steps);
  /// Begins step number `step`, of that period: changes the velocity, and says how it would move at it. With an empty
  /// battery it brakes to stand still, and what flies sinks to the floor.
  Arc latch(std::uint64_t step, Duration period);
  /// Ends it: the body has moved on that arc, unless a contact stopped it at a fraction of it.
  void publish(std::uint64_t step, Duration period, const Arc& arc, std::optional<double> stop);
  /// Ends it where forces decide: `tried` is what latch() said. A body that something touches, and that comes less than
  /// a tenth of what its drive tried, is stalled. Its wheels count what it went along them and how it turned, be it
  /// driven or pushed: held, they stand. What drags them sideways they do not count.
  void publish(std::uint64_t step, Duration period, const Arc& tried, const BodyMotion& motion);
  /// A person's hand puts it there, at rest.
  void put(const Pose& pose);

 private:
  void note_contact(bool stalled, bool tried);
  void go(std::uint64_t step, Duration period, const Arc& arc);
  Velocity wanted(std::uint64_t step, Duration period) const;

  const BodyDescription* description_;
  BodyState state_;
  Velocity commanded_;
  std::uint64_t commanded_at_ = 0;  // step
  BaseMotion motion_;               // from which the base goes on
  Outline outline_;                 // at state_.pose
  Odometer odometer_;
  std::optional<Battery> battery_;
};

}  // namespace waitpoint::world
