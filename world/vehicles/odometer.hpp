// SPDX-License-Identifier: BSD-3-Clause
// Wheel odometry with its errors, as counted by a base's controller.
//
//   systematic    travel and turn scaled; a turn for every metre (unequal wheels): grows with the signed distance
//   random        independent from step to step, with variances that grow with the distance and the angle moved
//   slip          wheels spin: a Poisson process in the distance, each event with an exponentially distributed excess
//                 distance and a normally distributed turn
//   quantisation  whole units; the remainder is carried, so the total error never exceeds half a unit
//
//   travel = s d + k_d sqrt|d| n1      turn = s_a a + c d + sqrt(k_ad^2 |d| + k_aa^2 |a|) n2
//
// The errors of two driven wheels are applied first: diameters in the ratio E_d (right to left, with the nominal mean),
// a wheel base of E_b times the nominal one, noise of each wheel, and the ticks of an encoder.
//
//   w_r, w_l = d +- a axle / 2                                    m_r = w_r (E_d + 1) / (2 E_d) + k_w sqrt|w_r| n_r
//   d' = (m_r + m_l) / 2       a' = E_b (m_r - m_l) / axle        m_l = w_l (E_d + 1) / 2       + k_w sqrt|w_l| n_l
//
// The systematic part is that of UMBmark (Borenstein and Feng 1996: wheel base and wheel diameters), the random part
// the usual model of a random walk in the distance.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/random.hpp"
#include "world/world.hpp"

namespace waitpoint::world {

/// A number of whole units, and the remainder in [-1/2, 1/2].
struct UnitCounter {
  std::int64_t total = 0;
  double rest = 0;

  /// Returns the whole units added to the total.
  std::int64_t add(double units);
};

class Odometer {
 public:
  /// Draws from streams (seed, robot, "odometry...") at tick = number of the step.
  Odometer(const BaseDescription& base, std::uint64_t seed, std::string_view robot);

  /// Draws from the streams of this seed from now on; what it has counted stays.
  void reseed(std::uint64_t seed, std::string_view robot) { draws_ = Draws(seed, robot); }

  /// Counts the base's motion in a step of `step_s` seconds; `moved` is from as_wheels_count().
  void add(std::uint64_t step, double step_s, const Arc& moved);
  const OdometerReading& reading() const { return reading_; }

 private:
  struct Draws {
    RandomStream noise, wheel_noise, slip;

    Draws(std::uint64_t seed, std::string_view robot);
  };
  struct Motion {
    double travel_m, turn_rad;
  };
  Motion of_wheels(std::uint64_t step, Motion moved);
  Motion slipped(std::uint64_t step, double distance_m) const;

  OdometryErrors errors_;
  double axle_m_;
  bool wheels_err_, random_;
  Draws draws_;
  UnitCounter travel_, turn_, side_;
  std::array<UnitCounter, 2> ticks_;  // left, right
  OdometerReading reading_;
};

}  // namespace waitpoint::world
