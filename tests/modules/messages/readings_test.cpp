// SPDX-License-Identifier: BSD-3-Clause
#include "modules/messages/readings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "modules/messages/poses.hpp"

namespace waitpoint::messages {
namespace {

constexpr double quarter = exact::pi / 2;
const Time date = time_of({3, 5});

TEST(MessageOfReading, BeamsWithoutEchoAreInfinite) {
  posters::LaserReading reading{
      .date = date, .first_angle_rad = -1, .angle_step_rad = 0.5, .range_max_m = 8, .range_m = {}};
  for (const float range_m : {1.0f, 8.0f, 9.0f}) reading.range_m.push_back(range_m);
  const sensor_msgs::LaserScan scan = message_of(reading, "laser");
  EXPECT_EQ(scan.header.stamp, (Stamp{3, 5}));
  EXPECT_EQ(scan.header.frame_id, "laser");
  EXPECT_EQ(scan.angle_max, 0);
  EXPECT_EQ(scan.ranges[0], 1);
  EXPECT_TRUE(std::isinf(scan.ranges[1]) && std::isinf(scan.ranges[2]));
}

TEST(MessageOfReading, ACovarianceOfThePlaneIsInRossRows) {
  const posters::PositionEstimate position{date, {1, 2, quarter}, {1, 2, 3, 4, 5, 6, 7, 8, 9}};
  const geometry_msgs::PoseWithCovarianceStamped message = message_of(position, "map");
  EXPECT_EQ(message.pose.covariance[0], 1);
  EXPECT_EQ(message.pose.covariance[5], 3);
  EXPECT_EQ(message.pose.covariance[7], 5);
  EXPECT_EQ(message.pose.covariance[35], 9);
  EXPECT_EQ(plane_covariance(message.pose.covariance), position.covariance);
  const Pose back = pose_of(message.pose.pose);
  EXPECT_EQ(back.x, 1);
  EXPECT_NEAR(back.heading, quarter, 1e-15);
}

TEST(MessageOfReading, AnInertialUnitHasNoOrientation) {
  const sensor_msgs::Imu imu = message_of(world::Imu::Reading{date, 1, 0.5, 1, 2, 9.8, 0}, "base");
  EXPECT_EQ(imu.orientation_covariance[0], -1);
  EXPECT_EQ(imu.angular_velocity.z, 0.5);
  EXPECT_EQ(imu.linear_acceleration.z, 9.8);
}

TEST(MessageOfReading, AFixIsAPointInItsFrame) {
  const geometry_msgs::PointStamped point = message_of(world::Gps::Reading{date, 1, {2, 3}, 4}, "map");
  EXPECT_EQ(point.header.frame_id, "map");
  EXPECT_EQ(point.point.x, 2);
  EXPECT_EQ(point.point.z, 4);
}

TEST(HeadingOfRotation, IsThatOfTheXAxisAlsoUpsideDown) {
  EXPECT_NEAR(heading_of(quaternion_of(1)), 1, 1e-15);
  EXPECT_NEAR(heading_of({0, 0, -2 * std::sin(0.5), -2 * std::cos(0.5)}), 1, 1e-15);
  EXPECT_NEAR(heading_of({1, 0, 0, 0}), 0, 1e-15);
}

}  // namespace
}  // namespace waitpoint::messages
