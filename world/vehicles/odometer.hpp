// SPDX-License-Identifier: BSD-3-Clause
// What a base's controller counts while the base moves: wheel odometry with its three kinds of error.
//
//   systematic    travel and turn scaled; a turn for every metre (unequal wheels): grows with the distance, with sign
//   random        independent of step to step, with variances that grow with the distance and the angle moved
//   quantisation  whole units; the rest is carried, so it never exceeds half a unit in all
//
//   travel = s d + k_d sqrt|d| n1      turn = s_a a + c d + sqrt(k_ad^2 |d| + k_aa^2 |a|) n2
//
// The systematic part is that of UMBmark (Borenstein and Feng 1996: wheel base and wheel diameters), the random part
// the usual model of a random walk in the distance.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/random.hpp"
#include "world/world.hpp"

namespace waitpoint::world {

class Odometer {
 public:
  /// Draws from the stream (seed, robot, "odometry") at tick = number of the step.
  Odometer(const OdometryErrors& errors, std::uint64_t seed, std::string_view robot);

  /// Counts what the base truly moved in that step of `step_s` seconds.
  void add(std::uint64_t step, double step_s, double distance_m, double turn_rad);
  const OdometerReading& reading() const { return reading_; }

 private:
  OdometryErrors errors_;
  RandomStream noise_;
  double travel_rest_ = 0, turn_rest_ = 0;  // units not yet counted, in [-1/2, 1/2]
  OdometerReading reading_;
};

}  // namespace waitpoint::world
