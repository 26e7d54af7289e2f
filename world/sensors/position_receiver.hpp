// SPDX-License-Identifier: BSD-3-Clause
// The position of a satellite receiver: a bias, a slow Gauss-Markov error, noise per fix, and dropouts.
//
//   d' = p d + D sqrt(1 - p^2) n,  p = e^(-T/tau)     on each axis: variance D^2, correlated by e^(-t/tau)
//   fix = q(truth + b + d + s n')
//
// so two positions at times t apart differ with the variance 2 D^2 (1 - e^(-t/tau)) + 2 s^2: errors of the atmosphere
// and of the satellites' positions last for minutes, and averaging over less does not remove them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/pose.hpp"
#include "core/random.hpp"
#include "world/sensor_description.hpp"
#include "world/world.hpp"

namespace waitpoint::world {

class PositionReceiver {
 public:
  /// Draws from the streams (seed, robot, "gps.drift"), (.., "gps.noise") and (.., "gps.dropout"), at tick = number of
  /// the try, index = axis.
  PositionReceiver(const PositionReceiverDescription& description, std::uint64_t seed, std::string_view robot);

  /// Draws from the streams of this seed from now on; the drift goes on from where it is.
  void reseed(std::uint64_t seed, std::string_view robot) { draws_ = Draws(seed, robot); }

  /// The body is at `pose` and `height_m` at the end of the step of length `step` that ends at `now` since the start.
  void add(Duration now, Duration step, const Pose& pose, double height_m);
  const PositionFix& fix() const { return fix_; }

 private:
  struct Draws {
    RandomStream drift, noise, dropout;

    Draws(std::uint64_t seed, std::string_view robot);
  };

  double measured(std::uint64_t axis, double true_m) const;

  PositionReceiverDescription description_;
  Draws draws_;
  double kept_;  // the correlation p of the drift from try to try
  std::array<double, 3> wandered_m_{};
  std::uint64_t tries_ = 0;
  PositionFix fix_;
};

}  // namespace waitpoint::world
