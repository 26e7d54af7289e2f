// SPDX-License-Identifier: BSD-3-Clause
// A body on its base: commands, motion, odometer and battery; the part of a world's step that is independent of the
// engine that finds the contacts.
#pragma once

#include <optional>

#include "world/planar/outline.hpp"
#include "world/vehicles/base.hpp"
#include "world/vehicles/battery.hpp"
#include "world/vehicles/odometer.hpp"

namespace waitpoint::world {

/// A body's motion in a step of a dynamic world.
struct BodyMotion {
  Point moved;  ///< in the world's frame
  double turned_rad = 0, climbed_m = 0;
  Velocity velocity;     ///< at the end, in the body's frame
  bool touched = false;  ///< by anything but the floor
};

class Vehicle {
 public:
  /// At its start, at rest. The description must outlive it.
  Vehicle(const BodyDescription& description, std::uint64_t seed);

  const BodyDescription& description() const { return *description_; }
  const BodyState& state() const { return state_; }
  const OdometerReading& odometer() const { return odometer_.reading(); }
  /// Adds the memory that queries of its state and commands touch.
  void add_to(WorkingSet& set) const { set.add_between(this, &motion_); }
  /// `elapsed_s` is the time since the start.
  Battery::Reading battery(double elapsed_s) const;
  /// Its outline in its current pose.
  const Outline& outline() const { return outline_; }
  /// Its shape in the body's frame, raised to its current height.
  Shape shape() const { return raised(description_->shape, state_.height_m); }

  /// Takes a command given after `steps` steps; NaN is a bug.
  void command(Velocity velocity, std::uint64_t steps);
  /// Begins step number `step`: updates the velocity, and returns the arc of a free motion at it. With an empty battery
  /// the body brakes to a stop, and an aerial body descends to the floor.
  Arc latch(std::uint64_t step, Duration period);
  /// Ends the step: the body has moved along `arc`, up to the fraction `stop` if a contact stopped it.
  void publish(std::uint64_t step, Duration period, const Arc& arc, std::optional<double> stop);
  /// Ends the step in a dynamic world; `tried` is the result of latch(). A body that is touched and moves less than a
  /// tenth of the tried motion is stalled. The wheels count travel along their direction and turns, driven or pushed;
  /// sideways drag is not counted.
  void publish(std::uint64_t step, Duration period, const Arc& tried, const BodyMotion& motion);
  /// See World::reseed().
  void reseed(std::uint64_t seed) { odometer_.reseed(seed, description_->name); }
  /// An intervention puts it there, at rest.
  void put(const Pose& pose);
  /// See World::guide_body(); NaN is a bug.
  void guide(const std::optional<Pose>& to, const Velocity& velocity);

 private:
  void note_contact(bool stalled, bool tried);
  void go(std::uint64_t step, Duration period, const Arc& arc);
  Velocity wanted(std::uint64_t step, Duration period) const;
  Arc latch_guided(double period_s);

  struct Guidance {
    std::optional<Pose> to;  // of the next step
    Velocity velocity;
  };

  const BodyDescription* description_;
  BodyState state_;
  Velocity commanded_;
  std::uint64_t commanded_at_ = 0;  // step
  BaseMotion motion_;               // the start of the next step's motion
  Outline outline_;                 // at state_.pose
  Odometer odometer_;
  std::optional<BatteryPack> battery_;
  std::optional<Guidance> guidance_;  // from outside
};

}  // namespace waitpoint::world
