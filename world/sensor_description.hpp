// SPDX-License-Identifier: BSD-3-Clause
// What a robot senses with, as values. Errors that a field says are off at 0 are off where it is left as it is.
#pragma once

#include <cstdint>

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
};

/// A ring of sonars on a cylinder about the body's centre, the first straight ahead, counter-clockwise.
struct SonarRingDescription {
  std::uint32_t count = 24;  ///< 0: none
  double ring_radius_m = 0.25, height_m = 0.6;
  double half_cone_rad = 0.218;  ///< a wall answers only if its normal lies inside
  double range_min_m = 0.15, range_max_m = 3;
  double range_noise_relative = 0.01;
  Duration period = std::chrono::milliseconds(120);  ///< of a full ring
};

}  // namespace waitpoint::world
