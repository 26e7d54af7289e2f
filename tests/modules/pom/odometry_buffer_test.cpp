// SPDX-License-Identifier: BSD-3-Clause
#include "modules/pom/odometry_buffer.hpp"
#include "tests/modules/milliseconds.hpp"

#include <gtest/gtest.h>

namespace waitpoint::pom {
namespace {

UncertainPose along_x(double x) { return {{x, 0, 0}, {0.001 * x, 0, 0, 0, 0.001 * x, 0, 0, 0, 0.001 * x}}; }

TEST(OdometryBuffer, InterpolatesBetweenDates) {
  OdometryBuffer buffer(8);
  buffer.add(ms(0), {{0, 0, 0}, {}});
  buffer.add(ms(20), {{2, 1, 0.4}, {}});
  const Pose half = buffer.at(ms(10)).pose;
  EXPECT_NEAR(half.x, 1, 1e-12);
  EXPECT_NEAR(half.y, 0.5, 1e-12);
  EXPECT_NEAR(half.heading, 0.2, 1e-12);
}

TEST(OdometryBuffer, InterpolatedUncertaintyGrowsWithTheMotion) {
  OdometryBuffer buffer(8);
  buffer.add(ms(0), along_x(1));
  buffer.add(ms(20), along_x(2));
  EXPECT_NEAR(buffer.at(ms(5)).covariance[0], 0.00125, 1e-12);
  EXPECT_NEAR(buffer.motion(ms(0), ms(5)).covariance[0], 0.00025, 1e-12);
}

TEST(OdometryBuffer, SortsWhatComesOutOfOrderAndIgnoresRepeatedDates) {
  OdometryBuffer buffer(8);
  for (const int n : {0, 40, 20, 60, 20}) buffer.add(ms(n), along_x(n));
  EXPECT_EQ(buffer.size(), 4u);
  for (const int n : {0, 10, 20, 30, 40, 50, 60}) EXPECT_NEAR(buffer.at(ms(n)).pose.x, n, 1e-12);
}

TEST(OdometryBuffer, DropsTheOldestWhenFull) {
  OdometryBuffer buffer(4);
  for (int n = 0; n < 100; n += 10) buffer.add(ms(n), along_x(n));
  EXPECT_EQ(buffer.oldest(), ms(60));
  EXPECT_EQ(buffer.newest(), ms(90));
  buffer.add(ms(50), along_x(50));
  EXPECT_EQ(buffer.oldest(), ms(60));
  buffer.add(ms(65), along_x(65));
  EXPECT_EQ(buffer.oldest(), ms(65));
  EXPECT_NEAR(buffer.at(ms(75)).pose.x, 75, 1e-12);
}

TEST(OdometryBuffer, GoesOnWithTheLastMotionUpToItsHorizon) {
  OdometryBuffer buffer(4);
  buffer.add(ms(0), along_x(0));
  buffer.add(ms(20), along_x(2));
  EXPECT_NEAR(buffer.at(ms(30), Duration(std::chrono::milliseconds(100))).pose.x, 3, 1e-12);
  EXPECT_NEAR(buffer.at(ms(500), Duration(std::chrono::milliseconds(100))).pose.x, 12, 1e-12);
  EXPECT_NEAR(buffer.at(ms(500)).pose.x, 2, 1e-12);
}

}  // namespace
}  // namespace waitpoint::pom
