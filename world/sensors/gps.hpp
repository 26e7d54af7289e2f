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
#include "world/sensors/surroundings.hpp"
#include "world/sensors/types/gps.hpp"

namespace waitpoint::world {

class Gps::Model {
 public:
  /// Draws from the streams (seed, robot, "gps.drift"), (.., "gps.noise") and (.., "gps.dropout"), at tick = number of
  /// the try, index = axis.
  Model(const Description& description, std::uint64_t seed, std::string_view robot);

  /// Draws from the streams of this seed from now on; the drift goes on from where it is.
  void reseed(std::uint64_t seed, std::string_view robot) { draws_ = Draws(seed, robot); }

  void moved(const StepDone& step, const BodyState& body);
  const Reading& reading() const { return fix_; }

 private:
  struct Draws {
    RandomStream drift, noise, dropout;

    Draws(std::uint64_t seed, std::string_view robot);
  };

  double measured(std::uint64_t axis, double true_m) const;

  Description description_;
  Draws draws_;
  double kept_;  // the correlation p of the drift from try to try
  std::array<double, 3> wandered_m_{};
  std::uint64_t tries_ = 0;
  Reading fix_;
};

}  // namespace waitpoint::world
