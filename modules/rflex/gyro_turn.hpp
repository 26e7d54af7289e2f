// SPDX-License-Identifier: BSD-3-Clause
// The angle turned by a robot's gyro, corrected for bias.
//
// The bias is the gyro's reading at rest: calibration averages it over some seconds. In a time T a gyro of noise
// density N determines the bias to N / sqrt(T).
#pragma once

#include "world/sensors/types/imu.hpp"

namespace waitpoint::rflex {

class GyroTurn {
 public:
  /// Adds a sample; the first only initialises the gyro's angle.
  void add(const world::Imu::Reading& sample);
  /// The last sample with the bias removed; `number` 0 before the first.
  const world::Imu::Reading& corrected() const { return corrected_; }

  /// The robot is at rest from now on, until end_calibration().
  void begin_calibration() { begun_ = corrected_; }
  /// Adds the mean reading since then to the bias and removes it from the angle; returns the new bias in rad/s. No
  /// effect without a sample since then.
  double end_calibration();

 private:
  double bias_rad_s_ = 0;
  world::Imu::Reading last_, corrected_, begun_;
};

}  // namespace waitpoint::rflex
