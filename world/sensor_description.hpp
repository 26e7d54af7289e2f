// SPDX-License-Identifier: BSD-3-Clause
// What a robot senses with, as values. Errors that a field says are off at 0 are off where it is left as it is.
#pragma once

#include <cstdint>
#include <vector>

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
  double warm_up_bias_m = 0;     ///< added at the start; falls to a 1/e of that in every warm_up_s
  double warm_up_s = 1800;
  double angle_noise_rad = 0;  ///< standard deviation of a beam's direction, anew in every scan
  double resolution_m = 0.01;  ///< quantisation
  Duration period = std::chrono::milliseconds(100);

  Duration mirror_turn;                ///< of a whole turn; 0: all beams at one instant
  std::uint32_t interlaced_turns = 1;  ///< beam i is measured in turn i modulo this

  double spot_m = 0, spot_divergence_rad = 0;  ///< the beam's diameter: spot_m + spot_divergence_rad x range; 0: a line
  double mixed_jump_m = 0.3;                   ///< a spot that falls on surfaces farther apart reads something between
  double dropout = 0;                          ///< probability that a beam's echo is lost
  double incidence_max_rad = 0.5 * exact::pi;  ///< from the surface's normal; what is flatter sends no echo

  std::uint32_t line_bit_s = 0;  ///< of the serial line that a scan comes over; 0: it is there at once

  friend bool operator==(const LaserDescription&, const LaserDescription&) = default;
};

/// A ring of sonars on a cylinder about the body's centre, the first straight ahead, counter-clockwise. Banks of
/// neighbours each have one that fires at a time: all members 0 of the banks at once, then all members 1, say.
struct SonarRingDescription {
  std::uint32_t count = 24;  ///< 0: none
  double ring_radius_m = 0.25, height_m = 0.6;
  double half_cone_rad = 0.218;  ///< a wall answers only if its normal lies inside
  double range_min_m = 0.15, range_max_m = 3;
  double range_noise_relative = 0.01;
  Duration period = std::chrono::milliseconds(120);  ///< of a full ring
  std::vector<std::uint32_t> firing_order;  ///< the members of a bank, as they take their turns; none: all at once
  bool crosstalk = false;                   ///< whether those that fire at once hear each other
  double air_celsius = 20, calibrated_celsius = 20;  ///< of the air, and that for which ranges are computed
};

/// Panels about a body, the first in front, counter-clockwise, each for the directions that it faces.
struct BumperDescription {
  std::uint32_t count = 14;
  double travel_m = 0.001;  ///< what comes so near presses
};

/// A ring of infrared range finders, the first straight ahead, counter-clockwise: what they give is a voltage V, and
/// the range is (gain_per_v V)^exponent.
struct InfraredRingDescription {
  std::uint32_t count = 24;
  double ring_radius_m = 0.25, height_m = 0.5;
  double range_min_m = 0.1, range_max_m = 0.8;
  double gain_per_v = 3.7, exponent = -1;
  double noise_v = 0.01;        ///< standard deviation
  double resolution_v = 0.005;  ///< quantisation
  Duration period = std::chrono::milliseconds(100);
};

/// Errors of one axis of an inertial sensor, in the unit U of what it measures.
struct InertialErrors {
  double noise_per_sqrt_hz = 0;     ///< white: the standard deviation of a mean over one second
  double bias = 0;                  ///< standard deviation of what is added from switching on
  double walk_per_sqrt_s = 0;       ///< of how far that has walked off after one second
  double drift = 0, drift_s = 100;  ///< a bias that wanders about 0: its standard deviation, and for how long it holds
  double scale = 1;                 ///< measured / true
  double resolution = 0;            ///< quantisation; 0: as fine as can be
  double max = 0;                   ///< what is beyond reads this; 0: there is no bound
};

/// An inertial measurement unit at the body's centre: a gyro about the vertical, three accelerometers.
struct ImuDescription {
  InertialErrors gyro;           ///< rad/s
  InertialErrors accelerometer;  ///< m/s2, each of the three
  Duration period = std::chrono::milliseconds(10);
};

/// A receiver of positions in the world's frame, as of satellites.
struct PositionReceiverDescription {
  Point antenna = {};  ///< in the body's frame
  double bias_x_m = 0, bias_y_m = 0;
  double drift_m = 0,
         drift_s =
             300;  ///< an error that wanders about 0: its standard deviation on each axis, and for how long it holds
  double noise_m = 0;          ///< standard deviation on each axis, anew in every fix
  double height_factor = 1.5;  ///< those of the height, in those of an axis
  double resolution_m = 0.01;  ///< quantisation
  double dropout = 0;          ///< probability that there is no fix
  Duration period = std::chrono::seconds(1);
};

}  // namespace waitpoint::world
