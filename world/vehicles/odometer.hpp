// SPDX-License-Identifier: BSD-3-Clause
// What a base's controller counts while the base moves: wheel odometry with its errors.
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

/// A number of whole units, and what is not counted yet, in [-1/2, 1/2].
struct UnitCounter {
  std::int64_t total = 0;
  double rest = 0;

  void add(double units);
};

class Odometer {
 public:
  /// Draws from the stream (seed, robot, "odometry") at tick = number of the step.
  Odometer(const BaseDescription& base, std::uint64_t seed, std::string_view robot);

  /// Counts what the base moved in that step of `step_s` seconds, as its wheels see it (as_wheels_count()).
  void add(std::uint64_t step, double step_s, const Arc& moved);
  const OdometerReading& reading() const { return reading_; }

 private:
  OdometryErrors errors_;
  RandomStream noise_;
  UnitCounter travel_, turn_, side_;
  OdometerReading reading_;
};

}  // namespace waitpoint::world
