// SPDX-License-Identifier: BSD-3-Clause
// How far a robot has turned by its gyro, less what the gyro is known to drift.
//
// The bias is what the gyro reads while the robot stands: calibrating takes its mean over some seconds. In a time T of
// it a gyro of noise density N tells the bias to N / sqrt(T).
#pragma once

#include "modules/posters/inertial.hpp"

namespace waitpoint::rflex {

class GyroTurn {
 public:
  /// Takes in a sample; the first only sets where the gyro stands.
  void add(const posters::Inertial& sample);
  /// The last sample, less the bias; `number` 0 before the first.
  const posters::Inertial& corrected() const { return corrected_; }

  /// From here on the robot stands, until end_calibration().
  void begin_calibration() { begun_ = corrected_; }
  /// Corrects the bias by the mean since then, and takes that out of the turn; the new bias in rad/s. Without a sample
  /// since then nothing changes.
  double end_calibration();

 private:
  double bias_rad_s_ = 0;
  posters::Inertial last_, corrected_, begun_;
};

}  // namespace waitpoint::rflex
