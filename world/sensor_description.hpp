// SPDX-License-Identifier: BSD-3-Clause
// The descriptions of sensors, as values. An error that is off at 0 is off by default.
#pragma once

#include <cstdint>
#include <vector>

#include "core/field_facts.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"

namespace waitpoint::world {

/// A planar fan of beams about the device's x axis, from a mirror that turns counter-clockwise.
struct LaserDescription {
  Pose mount;             ///< in the body's frame
  double height_m = 0.4;  ///< with the body on the floor
  std::uint32_t beams = 361;
  double field_of_view_rad = exact::pi;
  double range_max_m = 32;
  double range_noise_m = 0.005;  ///< standard deviation, to 8 m; grows linearly to that at 20 m
  double noise_growth = 2;       ///< the standard deviation from 20 m on, in those to 8 m
  double range_bias_m = 0;       ///< systematic, the same for every beam
  double warm_up_bias_m = 0;     ///< added at the start; decays by 1/e per warm_up_s
  double warm_up_s = 1800;
  double angle_noise_rad = 0;  ///< standard deviation of a beam's direction, drawn per scan
  double resolution_m = 0.01;  ///< quantisation
  Duration period = std::chrono::milliseconds(100);

  Duration mirror_turn;                ///< time of one turn; 0: all beams at one instant
  std::uint32_t interlaced_turns = 1;  ///< beam i is measured in turn i modulo this

  double spot_m = 0, spot_divergence_rad = 0;  ///< the beam's diameter: spot_m + spot_divergence_rad x range; 0: a line
  double mixed_jump_m = 0.3;                   ///< a spot on two surfaces farther apart reads a range between them
  double dropout = 0;                          ///< probability that a beam's echo is lost
  double incidence_max_rad = 0.5 * exact::pi;  ///< from the surface's normal; flatter incidence gives no echo

  std::uint32_t line_bit_s = 0;  ///< rate of the serial line that carries the scans; 0: no delay

  friend bool operator==(const LaserDescription&, const LaserDescription&) = default;
};

/// A ring of sonars on a cylinder about the body's centre, the first straight ahead, counter-clockwise. The ring is
/// divided into banks of neighbours, each with one firing member at a time: all members 0 at once, then all members 1,
/// for example.
struct SonarRingDescription {
  std::uint32_t count = 24;  ///< 0: none
  double ring_radius_m = 0.25, height_m = 0.6;
  double half_cone_rad = 0.218;  ///< a wall gives an echo only if its normal is inside
  double range_min_m = 0.15, range_max_m = 3;
  double range_noise_relative = 0.01;
  Duration period = std::chrono::milliseconds(120);  ///< of a full ring
  std::vector<std::uint32_t> firing_order;  ///< the members of a bank in the order of their turns; empty: all at once
  bool crosstalk = false;                   ///< sonars that fire at once hear each other
  double air_celsius = 20, calibrated_celsius = 20;  ///< true, and assumed in the computation of ranges
};

/// A ring of bumper panels, the first in front, counter-clockwise, each for an equal sector of directions.
struct BumperDescription {
  std::uint32_t count = 14;
  double travel_m = 0.001;  ///< a panel is pressed by anything nearer
};

/// A ring of infrared range finders, the first straight ahead, counter-clockwise. Each gives a voltage V; the range in
/// metres is (gain_per_v V)^exponent.
struct InfraredRingDescription {
  std::uint32_t count = 24;
  double ring_radius_m = 0.25, height_m = 0.5;
  double range_min_m = 0.1, range_max_m = 0.8;
  double gain_per_v = 3.7, exponent = -1;
  double noise_v = 0.01;        ///< standard deviation
  double resolution_v = 0.005;  ///< quantisation
  Duration period = std::chrono::milliseconds(100);
};

/// Errors of one axis of an inertial sensor, in the unit of its quantity.
struct InertialErrors {
  double noise_per_sqrt_hz = 0;     ///< white: the standard deviation of a mean over one second
  double bias = 0;                  ///< turn-on bias: its standard deviation
  double walk_per_sqrt_s = 0;       ///< random walk of the bias: standard deviation after one second
  double drift = 0, drift_s = 100;  ///< Gauss-Markov bias about 0: standard deviation, correlation time
  double scale = 1;                 ///< measured / true
  double resolution = 0;            ///< quantisation; 0: continuous
  double max = 0;                   ///< saturation; 0: none

  static void fields(auto field) {
    using Errors = InertialErrors;
    field("noise_per_sqrt_hz", &Errors::noise_per_sqrt_hz, ranges::rate_error,
          "white noise: the deviation of a mean over a second");
    field("bias", &Errors::bias, ranges::rate_error, "standard deviation of the turn-on bias");
    field("walk_per_sqrt_s", &Errors::walk_per_sqrt_s, ranges::rate_error,
          "random walk of the bias: its deviation after a second");
    field("drift", &Errors::drift, ranges::rate_error, "standard deviation of the bias that changes");
    field("drift_s", &Errors::drift_s, ranges::time_constant, "its correlation time");
    field("scale", &Errors::scale, ranges::factor, "measured by true");
    field("resolution", &Errors::resolution, ranges::resolution, "step of the readings; 0: none");
    field("max", &Errors::max, ranges::positive_number, "saturation; without it none");
  }
};

/// An inertial measurement unit at the body's centre: a gyro about the vertical, three accelerometers.
struct ImuDescription {
  InertialErrors gyro;           ///< rad/s
  InertialErrors accelerometer;  ///< m/s2, each of the three
  Duration period = std::chrono::milliseconds(10);

  static void fields(auto field) {
    field("gyro_rad_s", &ImuDescription::gyro, "errors of the gyro");
    field("accelerometer_m_s2", &ImuDescription::accelerometer, "errors of each accelerometer");
    field("period_ms", &ImuDescription::period, "of the readings");
  }
};

/// A receiver of positions in the world's frame, such as GPS.
struct PositionReceiverDescription {
  Point antenna = {};  ///< in the body's frame
  double bias_x_m = 0, bias_y_m = 0;
  double drift_m = 0,
         drift_s = 300;        ///< Gauss-Markov error about 0: standard deviation per axis, correlation time
  double noise_m = 0;          ///< standard deviation per axis, drawn per fix
  double height_factor = 1.5;  ///< errors of the height / errors of an axis
  double resolution_m = 0.01;  ///< quantisation
  double dropout = 0;          ///< probability that there is no fix
  Duration period = std::chrono::seconds(1);
};

}  // namespace waitpoint::world
