// SPDX-License-Identifier: BSD-3-Clause
// The interface between the bridge and a world. It has two implementations: a kinematic world (world/kinematic), where
// bodies move as commanded until a contact, and a world of forces (world/bullet), where drives push and loose obstacles
// are pushed.
//
// The world advances in steps of one period. Within step k, in this order:
//
//   latch    the commands given since step k - 1; each velocity changes by at most acceleration times the period
//   move     every body along its arc, to its first contact, found with the arcs of both bodies; or by forces
//   publish  {pose, arc}
//   sense    odometers, batteries, inertial sensors, receivers; scans on demand, until step k + 1
//
// Sensors see their own body in its current pose and the other bodies as published at step k - 1, so results depend
// neither on the order of the calls nor on where a body is simulated. Before the first step, every body is at its
// start.
//
// The order and the names of the bodies do not affect the run; a name only selects the body's random streams.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "core/time.hpp"
#include "core/working_set.hpp"
#include "world/arc.hpp"
#include "world/description.hpp"

namespace waitpoint::world {

/// A body, by its position in WorldDescription::bodies.
enum class BodyId : std::uint32_t {};
constexpr std::size_t index(BodyId id) { return static_cast<std::size_t>(id); }

/// The truth about a body, as published by the last step.
struct BodyState {
  Pose pose;  ///< seen from above
  Arc arc;  ///< of the last step: from the pose of the step before to this one, shorter than commanded after a contact
  Velocity velocity;             ///< now; zero after a contact
  bool stalled = false;          ///< the last motion tried was stopped or refused by a contact
  std::uint64_t collisions = 0;  ///< transitions from free to stalled
  double travelled_m = 0;        ///< sum of the lengths of the arcs
  double height_m = 0;           ///< above the floor; 0 unless aerial

  static void fields(auto field) {
    field("pose", &BodyState::pose);
    field("arc", &BodyState::arc);
    field("velocity", &BodyState::velocity);
    field("stalled", &BodyState::stalled);
    field("collisions", &BodyState::collisions);
    field("travelled_m", &BodyState::travelled_m);
    field("height_m", &BodyState::height_m, added);
  }
};

/// The truth about a loose obstacle, as published by the last step.
struct LooseState {
  std::uint32_t obstacle = 0;  ///< index into WorldDescription::obstacles, where its shape has the current pose
  Pose pose;                   ///< of its centre, seen from above
  double low_m = 0, high_m = 0;
  Point velocity_m_s;
  double climb_m_s = 0, w_rad_s = 0;

  static void fields(auto field) {
    field("obstacle", &LooseState::obstacle);
    field("pose", &LooseState::pose);
    field("low_m", &LooseState::low_m);
    field("high_m", &LooseState::high_m);
    field("velocity_m_s", &LooseState::velocity_m_s);
    field("climb_m_s", &LooseState::climb_m_s);
    field("w_rad_s", &LooseState::w_rad_s);
  }
};

/// The measurements of a base's controller. Travel, turn and the sideways travel of an omni base are accumulated since
/// the start, in the controller's units (OdometryErrors::units_per_m, units_per_rad).
struct OdometerReading {
  std::int64_t travel_units = 0, turn_units = 0;
  Velocity velocity;  ///< measured over the last step
  std::int64_t side_units = 0;

  static void fields(auto field) {
    field("travel_units", &OdometerReading::travel_units);
    field("turn_units", &OdometerReading::turn_units);
    field("velocity", &OdometerReading::velocity);
    field("side_units", &OdometerReading::side_units, added);
  }
};

/// A half line in the horizontal plane at `height_m`, in the world frame.
struct Beam {
  Point origin;
  double heading_rad = 0;
  double height_m = 0;
};

class World {
 public:
  virtual ~World() = default;

  /// Bodies as at the start; obstacles in their current state.
  virtual const WorldDescription& description() const = 0;

  /// Sets the velocity that the body tries to reach and hold, from the next step until the next command or until the
  /// base's watchdog (if any) expires. Components beyond the base's limits are clamped; components that the base does
  /// not have are ignored; NaN is a bug.
  virtual void command(BodyId id, Velocity velocity) = 0;
  /// Advances by one period.
  virtual void step() = 0;
  /// Steps done since the start: the world is at steps() times description().step.
  virtual std::uint64_t steps() const = 0;
  /// Back to the start, obstacles too, with the random streams of another seed (or the same).
  virtual void reset(std::uint64_t seed) = 0;

  /// Errors of sensors and odometers drawn from now on are those of this seed, at the same ticks; the state stays, with
  /// the biases and drifts so far.
  virtual void reseed(std::uint64_t seed) = 0;

  // Interventions between two steps. Each returns the reason for a refusal, and then has changed nothing.

  /// Lifts the body and puts it down at `pose`, at its present height, at rest. Its odometer does not notice; its
  /// command stays in force.
  virtual std::optional<std::string> move_body(BodyId id, const Pose& pose) = 0;
  /// From now on the body is guided from outside, as a real robot's is: commands and the limits of its base do not
  /// count. In the next step it moves along an arc to `to`, if given, and then on at `velocity` until the next call;
  /// contacts stop it as any body.
  virtual std::optional<std::string> guide_body(BodyId id, const std::optional<Pose>& to, const Velocity& velocity) = 0;
  /// Adds an obstacle, or replaces the first one of its name.
  virtual std::optional<std::string> put_obstacle(const Obstacle& obstacle) = 0;
  /// Removes the first obstacle of that name; false if there is none.
  virtual bool remove_obstacle(const std::string& name) = 0;
  /// Applies a horizontal force at the centre of the body of that name, or else of the loose obstacle, from the next
  /// step on for `time`, rounded up to whole steps.
  virtual std::optional<std::string> push(const std::string& name, Point force_n, Duration time) = 0;

  virtual const BodyState& body(BodyId id) const = 0;
  /// The loose obstacles, in the order of the obstacles; empty in a kinematic world.
  virtual std::span<const LooseState> loose() const = 0;
  virtual const OdometerReading& odometer(BodyId id) const = 0;
  /// Reads the body's sensor number `device` of type S. On demand: its readings of now, with the noise drawn at
  /// `number`, so that repeating a reading gives the same. Otherwise the last reading, unless `out` is that one
  /// (Reading::number): false, and `out` stays. A body without the sensor is a bug. The date stays as it is.
  ///
  /// Scans and firings of sonars are numbered from 1. A firing sets the ranges of the sonars whose turn it is, and
  /// keeps the others'; a reading of another size than the ring is reset to no echo first.
  template <class S>
  bool read(BodyId id, std::uint64_t number, typename S::Reading& out, std::size_t device = 0) const {
    return read_any(id, device, number, ReadingOut<S>{&out});
  }
  /// Announces a reading of a laser after the next step, so that the world can make all such scans together. The
  /// readings are those of a scan without announcement.
  virtual void expect_scan(BodyId id, std::size_t laser, std::uint64_t scan_number) = 0;
  /// Adds the memory that queries of the body's state, its commands and its announced scans touch, without memory that
  /// is shared by all bodies.
  virtual void add_to(WorkingSet& set, BodyId id) const = 0;
  /// Adds the further memory of a scan without announcement.
  virtual void add_scan_to(WorkingSet& set, BodyId id) const = 0;
  /// The distance along the beam to the first obstacle or body as seen by a sensor of the body `own` (the other bodies
  /// as published at the last step but one), without noise; range_max_m if nothing is nearer.
  virtual double cast(const Beam& beam, double range_max_m, std::optional<BodyId> own = std::nullopt) const = 0;

 private:
  virtual bool read_any(BodyId id, std::size_t device, std::uint64_t number, const AnyReadingOut& out) const = 0;
};

}  // namespace waitpoint::world
