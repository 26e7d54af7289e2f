// SPDX-License-Identifier: BSD-3-Clause
#include "modules/rflex/gyro_turn.hpp"

#include <gtest/gtest.h>

namespace waitpoint::rflex {
namespace {

/// Samples, ten a second, of a gyro that reads `rad_s`.
class Gyro {
 public:
  void give(GyroTurn& turn, double rad_s, int samples) {
    for (int i = 0; i < samples; ++i) {
      sample_.date += Duration(std::chrono::milliseconds(100));
      ++sample_.number;
      sample_.turn_rad_s = rad_s;
      sample_.turned_rad += 0.1 * rad_s;
      turn.add(sample_);
    }
  }

 private:
  world::Imu::Reading sample_;
};

TEST(GyroTurn, AddsUpWhatTheGyroTurnsFromItsFirstSampleOn) {
  GyroTurn turn;
  EXPECT_EQ(turn.corrected().number, 0u);
  Gyro gyro;
  gyro.give(turn, 0.5, 1);
  EXPECT_EQ(turn.corrected().turned_rad, 0);
  gyro.give(turn, 0.5, 20);
  EXPECT_NEAR(turn.corrected().turned_rad, 1, 1e-12);
  EXPECT_EQ(turn.corrected().turn_rad_s, 0.5);
}

TEST(GyroTurn, ACalibrationTakesTheMeanAtRestForTheBiasAndOutOfTheTurn) {
  GyroTurn turn;
  Gyro gyro;
  gyro.give(turn, 0.5, 11);
  turn.begin_calibration();
  gyro.give(turn, 0.02, 25);
  gyro.give(turn, 0.04, 25);
  EXPECT_NEAR(turn.end_calibration(), 0.03, 1e-12);
  EXPECT_NEAR(turn.corrected().turned_rad, 0.5, 1e-12);
  gyro.give(turn, 0.53, 10);
  EXPECT_NEAR(turn.corrected().turned_rad, 1, 1e-12);
  EXPECT_NEAR(turn.corrected().turn_rad_s, 0.5, 1e-12);
  turn.begin_calibration();
  gyro.give(turn, 0.02, 10);
  EXPECT_NEAR(turn.end_calibration(), 0.02, 1e-12) << "the next one corrects the first";
}

TEST(GyroTurn, ACalibrationWithoutSamplesChangesNothing) {
  GyroTurn turn;
  turn.begin_calibration();
  EXPECT_EQ(turn.end_calibration(), 0);
}

}  // namespace
}  // namespace waitpoint::rflex
