// SPDX-License-Identifier: BSD-3-Clause
// The description of a world, as values: read from a scenario or written by hand. During a run only interventions
// change it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/field_facts.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"
#include "world/convex_polygon.hpp"
#include "world/sensors/types/sensors.hpp"
#include "world/triangle_mesh.hpp"

namespace waitpoint::world {

inline constexpr double gravity_m_s2 = 9.81;

/// An upright solid from z_low_m to z_high_m: a box turned about the vertical, a cylinder, or a prism over a convex
/// polygon.
struct Shape {
  enum class Kind : std::uint8_t { box, cylinder, prism };
  Kind kind = Kind::box;
  Pose pose;                         ///< of the centre; a cylinder's heading does not matter to its outline
  double length_m = 0, width_m = 0;  ///< along its own x and y: of a box, or of the box about a prism
  double radius_m = 0;               ///< cylinder
  double z_low_m = 0, z_high_m = 1;
  std::shared_ptr<const ConvexPolygon> polygon = {};  ///< prism: about its centre; shared, since shapes are copied

  friend bool operator==(const Shape& a, const Shape& b) {
    const bool same_polygon = a.polygon == b.polygon || (a.polygon && b.polygon && *a.polygon == *b.polygon);
    return same_polygon && a.kind == b.kind && a.pose == b.pose && a.length_m == b.length_m && a.width_m == b.width_m &&
           a.radius_m == b.radius_m && a.z_low_m == b.z_low_m && a.z_high_m == b.z_high_m;
  }
};

/// A fixed solid; one with a mass can be pushed in a dynamic world.
struct Obstacle {
  std::string name;
  Shape shape;
  bool known = true;      ///< in the map given to planners
  double mass_kg = 0;     ///< 0: fixed; a kinematic world ignores it: everything is fixed there
  double friction = 0.5;  ///< of a loose obstacle: with the floor

  bool loose() const { return mass_kg > 0; }
};

/// Errors of wheel odometry, see vehicles/odometer.hpp. The first group are errors of the controller's result, for
/// every kind of base; the wheel errors apply only to bases with two driven sides.
struct OdometryErrors {
  double travel_scale = 1;
  double turn_scale = 1;
  double drift_rad_per_m = 0;
  double travel_noise_m_per_sqrt_m = 0;
  double turn_noise_rad_per_sqrt_m = 0;
  double turn_noise_rad_per_sqrt_rad = 0;
  double slips_per_m = 0;
  double slip_m = 0;
  double slip_turn_rad = 0;
  double units_per_m = 103000;
  double units_per_rad = 35000;

  double wheel_diameter_ratio = 1;
  double wheel_base_ratio = 1;
  double wheel_noise_m_per_sqrt_m = 0;
  double wheel_ticks_per_m = 0;

  static void fields(auto field) {
    using Errors = OdometryErrors;
    constexpr NumberRange slips{0, 1000, "a number from 0 to 1000"};
    field("travel_scale", &Errors::travel_scale, ranges::factor, "measured by true distance, sideways too");
    field("turn_scale", &Errors::turn_scale, ranges::factor,
          "measured by true turn: E_b of the controller, or the turn gear");
    field("drift_rad_per_m", &Errors::drift_rad_per_m, ranges::signed_angle_error,
          "systematic turn for each metre: unequal wheels, or the heading gear");
    field("travel_noise_m_per_sqrt_m", &Errors::travel_noise_m_per_sqrt_m, ranges::length_error,
          "standard deviation of the distance after a metre");
    field("turn_noise_rad_per_sqrt_m", &Errors::turn_noise_rad_per_sqrt_m, ranges::angle_error,
          "standard deviation of the turn after a metre");
    field("turn_noise_rad_per_sqrt_rad", &Errors::turn_noise_rad_per_sqrt_rad, ranges::angle_error,
          "standard deviation of the turn after a turn by a radian");
    field("slips_per_m", &Errors::slips_per_m, slips, "mean rate at which wheels spin");
    field("slip_m", &Errors::slip_m, ranges::length_error, "mean excess distance counted for a slip");
    field("slip_turn_rad", &Errors::slip_turn_rad, ranges::angle_error, "standard deviation of the turn of a slip");
    field("units_per_m", &Errors::units_per_m, ranges::units, "quantisation of distances");
    field("units_per_rad", &Errors::units_per_rad, ranges::units, "quantisation of turns");
    field("wheel_diameter_ratio", &Errors::wheel_diameter_ratio, ranges::factor, "right by left wheel, E_d of UMBmark");
    field("wheel_base_ratio", &Errors::wheel_base_ratio, ranges::factor,
          "actual by nominal distance of the wheels, E_b of UMBmark");
    field("wheel_noise_m_per_sqrt_m", &Errors::wheel_noise_m_per_sqrt_m, ranges::length_error,
          "standard deviation of a wheel's distance after a metre");
    field("wheel_ticks_per_m", &Errors::wheel_ticks_per_m, ranges::units,
          "of a wheel's encoder; without it continuous");
  }
};

/// A body's mobile base; vehicles/base.hpp describes the motions of each kind.
struct BaseDescription {
  enum class Kind : std::uint8_t { differential, synchro, omni, ackermann, skid_steer, aerial };
  Kind kind = Kind::synchro;
  double v_max_m_s = 0.9, w_max_rad_s = 1.5;
  double v_acceleration_m_s2 = 1.0, w_acceleration_rad_s2 = 3.0;
  double axle_m = 0.4;
  double effective_axle_ratio = 1.5;
  double wheelbase_m = 0.5;
  double steering_max_rad = 0.6;
  double steering_rate_rad_s = 0.8;
  double climb_max_m_s = 0.5, climb_acceleration_m_s2 = 1.0;  ///< aerial
  double mass_kg = 50;
  double drive_force_n = 0;
  double grip = 0.8;
  Duration watchdog;
  OdometryErrors odometry;
  double battery_volts_full = 26.0, battery_volts_empty = 22.0;
  double battery_capacity_s = 4 * 3600;
  double battery_capacity_m = 8000;

  static constexpr std::string_view kinds[] = {"differential", "synchro", "omni", "ackermann", "skid_steer", "aerial"};
  static constexpr NumberRange volts{0, 1e5, "a number of volts from 0 to 100000"};

  /// All but the errors of the odometry.
  static void fields(auto field) {
    using Base = BaseDescription;
    constexpr NumberRange longer{1, 1e3, "a number from 1 to 1000"};
    constexpr NumberRange steering{least_nonzero, 89, "degrees above 0, at most 89"};
    constexpr NumberRange steering_rate{1e-3, 1e6, "degrees per second from 0.001 to 1000000"};
    constexpr NumberRange mass{1e-3, 1e6, "a number of kg from 0.001 to 1000000"};
    constexpr NumberRange force{1e-3, 1e9, "a number of newtons from 0.001 to 1e9"};
    constexpr NumberRange friction{0, 1e3, "a number from 0 to 1000"};
    constexpr NumberRange metres{1e-3, 1e9, "a number of metres from 0.001 to 1e9"};
    field("kind", &Base::kind, Words{kinds}, "how it moves");
    field("v_max_m_s", &Base::v_max_m_s, ranges::rate, "greatest speed");
    field("w_max_rad_s", &Base::w_max_rad_s, ranges::rate, "greatest turn rate");
    field("v_acceleration_m_s2", &Base::v_acceleration_m_s2, ranges::acceleration, "greatest acceleration");
    field("w_acceleration_rad_s2", &Base::w_acceleration_rad_s2, ranges::acceleration, "of turns");
    field("axle_m", &Base::axle_m, ranges::length, "distance between the wheels of two sides");
    field("effective_axle_ratio", &Base::effective_axle_ratio, longer, "skid_steer: effective axle in turns by axle_m");
    field("wheelbase_m", &Base::wheelbase_m, ranges::length, "ackermann: between the front and the rear axle");
    field("steering_max_deg", &Base::steering_max_rad, degrees, steering,
          "ackermann: of the equivalent single front wheel");
    field("steering_rate_deg_s", &Base::steering_rate_rad_s, degrees, steering_rate, "ackermann: of the front wheels");
    field("climb_max_m_s", &Base::climb_max_m_s, ranges::rate, "aerial: greatest vertical speed");
    field("climb_acceleration_m_s2", &Base::climb_acceleration_m_s2, ranges::acceleration, "aerial: vertical");
    field("mass_kg", &Base::mass_kg, mass, "dynamic worlds: of the whole robot");
    field("drive_force_n", &Base::drive_force_n, force,
          "dynamic worlds: the greatest; without it twice that for the acceleration");
    field("grip", &Base::grip, friction, "dynamic worlds: friction of the wheels with the floor");
    field("watchdog_ms", &Base::watchdog, "without a command for longer than this the base stops; without it never");
    field("battery_volts_full", &Base::battery_volts_full, volts, "voltage of the full battery");
    field("battery_volts_empty", &Base::battery_volts_empty, volts, "voltage of the empty battery");
    field("battery_capacity_s", &Base::battery_capacity_s, ranges::time_constant, "until empty, standing still");
    field("battery_capacity_m", &Base::battery_capacity_m, metres, "until empty, if only driving drained it");
  }
};

/// A robot's body with its sensors.
struct BodyDescription {
  std::string name;
  Shape shape;  ///< pose in the body's frame, heights with the body on the floor
  Pose start;
  double start_height_m = 0;  ///< of an aerial body above the floor
  BaseDescription base;
  Equipment equipment;  ///< without a battery: the base's figures, and unlimited power

  /// The descriptions of its sensors of type S: a list, or one that is optional.
  template <class S>
  const DescriptionsOf<S>& sensors() const {
    return equipment.of<S>();
  }
  template <class S>
  DescriptionsOf<S>& sensors() {
    return equipment.of<S>();
  }
};

/// The engine that finds hits of planar beams and obstacles near a body. `fcl` (FCL's trees) and `slice` (trees over
/// exact slices at the heights of the sensors, and over footprints, world/slice) give the same world to the last bit.
/// `bullet` is a world of forces (world/bullet) with the beams of the slices.
enum class Engine : std::uint8_t { fcl, slice, bullet };

struct WorldDescription {
  Duration step = std::chrono::milliseconds(10);
  Engine engine = Engine::fcl;
  std::vector<Obstacle> obstacles;   ///< including a map's occupied cells, merged into boxes
  std::vector<MeshObstacle> meshes;  ///< fixed; interventions cannot change them
  std::vector<BodyDescription> bodies;
};

}  // namespace waitpoint::world
