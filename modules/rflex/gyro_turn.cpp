// SPDX-License-Identifier: BSD-3-Clause
#include "modules/rflex/gyro_turn.hpp"

namespace waitpoint::rflex {

void GyroTurn::add(const world::Imu::Reading& sample) {
  double turned_rad = corrected_.turned_rad;
  if (last_.number > 0)
    turned_rad += sample.turned_rad - last_.turned_rad - bias_rad_s_ * (sample.date - last_.date).seconds();
  last_ = sample;
  corrected_ = sample;
  corrected_.turn_rad_s -= bias_rad_s_;
  corrected_.turned_rad = turned_rad;
}

double GyroTurn::end_calibration() {
  if (begun_.number == 0 || corrected_.number == begun_.number) return bias_rad_s_;
  bias_rad_s_ += (corrected_.turned_rad - begun_.turned_rad) / (corrected_.date - begun_.date).seconds();
  corrected_.turned_rad = begun_.turned_rad;
  return bias_rad_s_;
}

}  // namespace waitpoint::rflex
