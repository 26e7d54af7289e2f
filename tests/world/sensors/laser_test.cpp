// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/laser.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/world/sensors/statistics.hpp"

namespace waitpoint::world {
namespace {

Statistics measured(const LaserDescription& description, double true_m, std::uint64_t seed = 1) {
  const Laser laser(description, seed, "robot", 0);
  std::vector<double> ranges, errors;
  for (std::uint64_t scan = 1; scan <= 600; ++scan) {
    ranges.assign(361, true_m);
    laser.measure(scan, 0, ranges);
    for (const double r : ranges) errors.push_back(r - true_m);
  }
  return statistics_of(errors);
}

TEST(Laser, NoiseGrowsFromTheDataSheetsFiveMillimetresToTen) {
  LaserDescription laser;
  laser.resolution_m = 0;
  for (const auto& [range, deviation] :
       {std::pair{1.0, 0.005}, {7.9, 0.005}, {14.0, 0.0075}, {20.0, 0.01}, {30.0, 0.01}}) {
    const Statistics s = measured(laser, range);
    EXPECT_NEAR(s.deviation, deviation, 0.01 * deviation) << range;
    EXPECT_NEAR(s.mean, 0, 4 * deviation / std::sqrt(361.0 * 600)) << range;
  }
}

TEST(Laser, NoiseThatDoesNotGrowStays) {
  LaserDescription laser;
  laser.resolution_m = 0;
  laser.noise_growth = 1;
  for (const double range : {1.0, 14.0, 30.0}) EXPECT_NEAR(measured(laser, range).deviation, 0.005, 5e-5) << range;
}

TEST(Laser, BiasShiftsEveryBeam) {
  LaserDescription laser;
  laser.resolution_m = 0;
  laser.range_bias_m = 0.015;
  EXPECT_NEAR(measured(laser, 5).mean, 0.015, 1e-4);
}

TEST(Laser, QuantisationGivesWholeStepsAndItsOwnVariance) {
  LaserDescription laser;
  const Laser device(laser, 1, "robot", 0);
  std::vector<double> ranges(361, 4.321);
  device.measure(1, 0, ranges);
  for (const double r : ranges) EXPECT_NEAR(r, std::nearbyint(r / 0.01) * 0.01, 1e-12);
  const double expected = std::sqrt(0.005 * 0.005 + 0.01 * 0.01 / 12);
  EXPECT_NEAR(measured(laser, 4.3217).deviation, expected, 0.03 * expected);
}

TEST(Laser, NoEchoReadsTheGreatestRangeExactlyAndNothingIsNegative) {
  LaserDescription laser;
  laser.range_noise_m = 0.5;
  const Laser device(laser, 1, "robot", 0);
  std::vector<double> ranges(361, 32);
  device.measure(1, 0, ranges);
  for (const double r : ranges) EXPECT_EQ(r, 32);
  ranges.assign(361, 31.99);
  device.measure(1, 0, ranges);
  for (const double r : ranges) EXPECT_LE(r, 32);
  ranges.assign(361, 0.01);
  device.measure(1, 0, ranges);
  for (const double r : ranges) EXPECT_GE(r, 0);
}

TEST(Laser, EveryRobotDeviceAndScanDrawsItsOwn) {
  LaserDescription description;
  const auto first_range = [&](std::uint64_t seed, const char* robot, std::size_t number, std::uint64_t scan) {
    std::vector<double> ranges(4, 5);
    LaserDescription fine = description;
    fine.resolution_m = 0;
    Laser(fine, seed, robot, number).measure(scan, 0, ranges);
    EXPECT_NE(ranges[0], ranges[1]);
    EXPECT_NE(ranges[0], ranges[2]);
    return ranges[0];
  };
  const double range = first_range(1, "a", 0, 1);
  EXPECT_EQ(first_range(1, "a", 0, 1), range);
  EXPECT_NE(first_range(2, "a", 0, 1), range);
  EXPECT_NE(first_range(1, "b", 0, 1), range);
  EXPECT_NE(first_range(1, "a", 1, 1), range);
  EXPECT_NE(first_range(1, "a", 0, 2), range);
}

TEST(Laser, BeamsFanOutCounterClockwiseAboutTheAxis) {
  LaserDescription description;
  const Laser laser(description, 1, "robot", 0);
  EXPECT_NEAR(laser.angle_step_rad(), exact::pi / 360, 1e-15);
  ASSERT_EQ(laser.directions().size(), 361u);
  EXPECT_NEAR(laser.directions()[0].y, -1, 1e-15);
  EXPECT_NEAR(laser.directions()[180].x, 1, 1e-15);
  EXPECT_NEAR(laser.directions()[360].y, 1, 1e-15);
}

}  // namespace
}  // namespace waitpoint::world
