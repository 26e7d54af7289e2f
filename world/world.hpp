// SPDX-License-Identifier: BSD-3-Clause
// The world server: what the bridge sees of a world, so that another engine can take its place. There are two: a
// kinematic one (world/fcl), where bodies move as they are told until they touch something, and one of forces
// (world/bullet), where drives push and loose things are pushed.
//
// The world advances in steps of one period. Within step k, in this order:
//
//   latch    the commands given since step k - 1; each velocity changes by at most acceleration times the period
//   move     every body along its arc, to its first contact, found with the arcs of both bodies; or as forces will
//   publish  {pose, arc}
//   sense    odometers, batteries, inertial sensors, receivers; and, whenever asked before step k + 1, scans
//
// Sensors see their own body as it is now and the other bodies as published at step k - 1, so that the order in which
// bodies are asked (or where they are simulated) cannot matter. Before the first step, everything is where it starts.
//
// The order and the names of the bodies do not change what happens; the name only chooses a body's random streams.
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
  double height_m = 0;           ///< above the floor; of what cannot fly always 0

  static constexpr auto fields() {
    return std::tuple(field("pose", &BodyState::pose), field("arc", &BodyState::arc),
                      field("velocity", &BodyState::velocity), field("stalled", &BodyState::stalled),
                      field("collisions", &BodyState::collisions), field("travelled_m", &BodyState::travelled_m),
                      added_field("height_m", &BodyState::height_m));
  }
};

/// The truth about an obstacle that can move, as published by the last step.
struct LooseState {
  std::uint32_t obstacle = 0;  ///< which of WorldDescription::obstacles, whose shape is where it is now
  Pose pose;                   ///< of its centre, seen from above
  double low_m = 0, high_m = 0;
  Point velocity_m_s;
  double climb_m_s = 0, w_rad_s = 0;

  static constexpr auto fields() {
    return std::tuple(field("obstacle", &LooseState::obstacle), field("pose", &LooseState::pose),
                      field("low_m", &LooseState::low_m), field("high_m", &LooseState::high_m),
                      field("velocity_m_s", &LooseState::velocity_m_s), field("climb_m_s", &LooseState::climb_m_s),
                      field("w_rad_s", &LooseState::w_rad_s));
  }
};

/// What a base's controller measures. Travel, turn and what an omni base goes sideways are accumulated since the start
/// in the controller's own units (OdometryErrors::units_per_m, units_per_rad).
struct OdometerReading {
  std::int64_t travel_units = 0, turn_units = 0;
  Velocity velocity;  ///< measured over the last step
  std::int64_t side_units = 0;

  static constexpr auto fields() {
    return std::tuple(field("travel_units", &OdometerReading::travel_units),
                      field("turn_units", &OdometerReading::turn_units), field("velocity", &OdometerReading::velocity),
                      added_field("side_units", &OdometerReading::side_units));
  }
};

/// What a battery gives.
struct BatteryState {
  double volts = 0, current_a = 0;
  double charge = 1;                      ///< left, of its capacity
  std::optional<Duration> empty_at = {};  ///< since the start; then what it feeds went off, and stays so
};

/// Means over the time since the sample before, in the body's frame.
struct ImuSample {
  std::uint64_t number = 0;                           ///< of samples so far; 0: none yet
  double turn_rad_s = 0;                              ///< of the gyro
  double ahead_m_s2 = 0, left_m_s2 = 0, up_m_s2 = 0;  ///< at rest the last is gravity's
  double turned_rad = 0;                              ///< what the gyro's samples add up to since the start
};

/// Where a receiver takes its antenna to be, in the world's frame.
struct PositionFix {
  std::uint64_t number = 0;  ///< of fixes so far; 0: none yet
  Point position;
  double height_m = 0;
};

/// One scan of a laser, counter-clockwise, in the device's frame. Reused between scans, it allocates only once.
struct LaserScan {
  double first_angle_rad = 0, angle_step_rad = 0;
  double range_max_m = 0;       ///< a beam without echo reads this
  std::vector<double> range_m;  ///< as measured: with noise, quantised
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

  /// Bodies as at the start; obstacles as they are now.
  virtual const WorldDescription& description() const = 0;

  /// Sets the velocity that the body tries to reach and hold, from the next step on, until the base's watchdog (if it
  /// has one) finds that no other command came. Velocities beyond the base's limits are clamped to them, those in which
  /// it cannot go at all are left out; NaN is a bug.
  virtual void command(BodyId id, Velocity velocity) = 0;
  /// Advances by one period.
  virtual void step() = 0;
  /// Steps done since the start: the world is at steps() times description().step.
  virtual std::uint64_t steps() const = 0;
  /// Back to the start, obstacles too, with the random streams of another seed (or the same).
  virtual void reset(std::uint64_t seed) = 0;

  // What a person does, between two steps. Each says what stands in the way, and then has changed nothing.

  /// Lifts the body and puts it down there, as high as it was, at rest: its odometer does not notice, its command
  /// holds.
  virtual std::optional<std::string> move_body(BodyId id, const Pose& pose) = 0;
  /// Adds an obstacle, or puts it in place of the first one of its name.
  virtual std::optional<std::string> put_obstacle(const Obstacle& obstacle) = 0;
  /// Takes away the first obstacle of that name; false if there is none.
  virtual bool remove_obstacle(const std::string& name) = 0;
  /// From the next step on, for that long, rounded up to whole steps, a level force acts at the centre of the body of
  /// that name, or else of the loose obstacle.
  virtual std::optional<std::string> push(const std::string& name, Point force_n, Duration time) = 0;

  virtual const BodyState& body(BodyId id) const = 0;
  /// What can be pushed, in the order of the obstacles; nothing in a kinematic world.
  virtual std::span<const LooseState> loose() const = 0;
  virtual const OdometerReading& odometer(BodyId id) const = 0;
  virtual BatteryState battery(BodyId id) const = 0;
  /// The last sample of the body's inertial measurement unit, which it must have.
  virtual const ImuSample& imu(BodyId id) const = 0;
  /// The last fix of the body's receiver, which it must have.
  virtual const PositionFix& position_fix(BodyId id) const = 0;

  /// Scans with the body's laser number `laser`. The noise of beam i is drawn at (scan_number, i): the same scan asked
  /// twice is the same.
  virtual void scan(BodyId id, std::size_t laser, std::uint64_t scan_number, LaserScan& out) const = 0;
  /// Says that scan() will be asked for this one after the next step: the server may make all those together. It reads
  /// the same as one that comes unexpected.
  virtual void expect_scan(BodyId id, std::size_t laser, std::uint64_t scan_number) = 0;
  /// Fires the sonars of the body's ring number `ring` whose turn firing `firing_number` is, all at once where the ring
  /// has no order. Their ranges are set, no echo reading the ring's greatest range; the others' stay. If `range_m` is
  /// of another size than the ring, all begin without echo. Noise as for scan().
  virtual void sonar(BodyId id, std::size_t ring, std::uint64_t firing_number, std::vector<double>& range_m) const = 0;
  /// The panels of the body's bumper that are pressed, panel i by bit i; 0 without a bumper. Other bodies as published
  /// at the last step but one.
  virtual std::uint32_t bumpers(BodyId id) const = 0;
  /// Reads the voltages of the body's infrared range finders, which it must have; `volts` is resized. Noise as for
  /// scan().
  virtual void infrareds(BodyId id, std::uint64_t reading_number, std::vector<double>& volts) const = 0;
  /// Adds what asking for the body's state, commanding it and scans that are expected touch, without what is
  /// everybody's.
  virtual void add_to(WorkingSet& set, BodyId id) const = 0;
  /// Adds what a scan that nobody expected touches besides.
  virtual void add_scan_to(WorkingSet& set, BodyId id) const = 0;
  /// The distance along the beam to the first obstacle or body as a sensor of the body `own` sees them (all bodies as
  /// published at the last step but one, without `own`), without noise; range_max_m if there is none nearer.
  virtual double cast(const Beam& beam, double range_max_m, std::optional<BodyId> own = std::nullopt) const = 0;
};

}  // namespace waitpoint::world
