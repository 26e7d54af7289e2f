// SPDX-License-Identifier: BSD-3-Clause
// What is given about a laser, in place of what its log has.
#include "modules/logs/given_laser.hpp"

#include <gtest/gtest.h>

namespace waitpoint::logs {
namespace {

SensorLog log_with(std::vector<std::size_t> beams) {
  SensorLog log;
  log.mount = {1, 2, 3};
  for (const std::size_t count : beams)
    log.scans.push_back({.stamp = Time(),
                         .first_angle_rad = 0.5,
                         .angle_step_rad = 0.25,
                         .range_max_m = 80,
                         .range_m = std::vector<float>(count)});
  return log;
}

TEST(GivenLaser, TheFieldOfViewIsFromTheFirstBeamToTheLastOfEachScan) {
  SensorLog log = log_with({5, 3, 1, 0});
  apply({.field_of_view_rad = 2}, log);
  EXPECT_EQ(log.scans[0].first_angle_rad, -1);
  EXPECT_EQ(log.scans[0].angle_step_rad, 0.5);
  EXPECT_EQ(log.scans[1].first_angle_rad, -1);
  EXPECT_EQ(log.scans[1].angle_step_rad, 1);
  EXPECT_EQ(log.scans[2].first_angle_rad, 0);
  EXPECT_EQ(log.mount.x, 1);
  EXPECT_EQ(log.scans[0].range_max_m, 80);
}

TEST(GivenLaser, MountAndRangeAreReplacedAndTheRestIsOfTheLog) {
  SensorLog log = log_with({5});
  apply({.mount = Pose{0.1, 0, 0.2}, .range_max_m = 30}, log);
  EXPECT_EQ(log.mount.x, 0.1);
  EXPECT_EQ(log.mount.heading, 0.2);
  EXPECT_EQ(log.scans[0].range_max_m, 30);
  EXPECT_EQ(log.scans[0].first_angle_rad, 0.5);
  EXPECT_EQ(log.scans[0].angle_step_rad, 0.25);
}

}  // namespace
}  // namespace waitpoint::logs
