// SPDX-License-Identifier: BSD-3-Clause
#include "modules/messages/readings.hpp"

#include <algorithm>

#include "modules/messages/poses.hpp"

namespace waitpoint::messages {

geometry_msgs::TransformStamped transform_message(Time date, const std::string& parent, const std::string& child,
                                                  const Pose& pose, double z_m) {
  return {header_of(date, parent), child, {{pose.x, pose.y, z_m}, quaternion_of(pose.heading)}};
}

geometry_msgs::PoseStamped pose_message(Time date, const std::string& frame, const Pose& pose, double z_m) {
  return {header_of(date, frame), pose_message(pose, z_m)};
}

geometry_msgs::PoseWithCovarianceStamped message_of(const posters::PositionEstimate& position,
                                                    const std::string& frame) {
  return {header_of(position.date, frame), {pose_message(position.pose), space_covariance(position.covariance)}};
}

nav_msgs::Odometry message_of(const posters::Odometry& odometry, const std::string& frame, const std::string& child) {
  const posters::PositionEstimate& position = odometry.position;
  nav_msgs::Odometry message{header_of(position.date, frame), child, {}, {}};
  message.pose = {pose_message(position.pose, odometry.height_m), space_covariance(position.covariance)};
  message.twist.twist.linear.x = odometry.v_m_s;
  message.twist.twist.angular.z = odometry.w_rad_s;
  return message;
}

sensor_msgs::LaserScan scan_message(Time date, const std::string& frame, double first_angle_rad, double angle_step_rad,
                                    std::size_t beams, double range_max_m) {
  const auto steps = static_cast<double>(std::max<std::size_t>(beams, 1) - 1);
  sensor_msgs::LaserScan message;
  message.header = header_of(date, frame);
  message.angle_min = static_cast<float>(first_angle_rad);
  message.angle_max = static_cast<float>(first_angle_rad + steps * angle_step_rad);
  message.angle_increment = static_cast<float>(angle_step_rad);
  message.range_max = static_cast<float>(range_max_m);
  message.ranges.reserve(beams);
  return message;
}

sensor_msgs::LaserScan message_of(const posters::LaserReading& scan, const std::string& frame) {
  sensor_msgs::LaserScan message =
      scan_message(scan.date, frame, scan.first_angle_rad, scan.angle_step_rad, scan.range_m.size(), scan.range_max_m);
  for (const float range_m : scan.range_m) message.ranges.push_back(range_or_infinity(range_m, scan.range_max_m));
  return message;
}

sensor_msgs::Imu message_of(const world::Imu::Reading& inertial, const std::string& frame) {
  sensor_msgs::Imu message;
  message.header = header_of(inertial.date, frame);
  message.orientation_covariance[0] = -1;  // none is measured
  message.angular_velocity.z = inertial.turn_rad_s;
  message.linear_acceleration = {inertial.ahead_m_s2, inertial.left_m_s2, inertial.up_m_s2};
  return message;
}

geometry_msgs::PointStamped message_of(const world::Gps::Reading& fix, const std::string& frame) {
  return {header_of(fix.date, frame), {fix.position.x, fix.position.y, fix.height_m}};
}

nav_msgs::OccupancyGrid message_of(const OccupancyGrid& grid, Time date, const std::string& frame) {
  constexpr std::int8_t free = 0, occupied = 100, unknown = -1;
  nav_msgs::OccupancyGrid message;
  message.header = header_of(date, frame);
  message.info = {message.header.stamp, static_cast<float>(grid.resolution_m()),
                  static_cast<std::uint32_t>(grid.width()), static_cast<std::uint32_t>(grid.height()),
                  pose_message(grid.origin())};
  message.data.reserve(grid.cells().size());
  for (const Cell cell : grid.cells())
    message.data.push_back(cell == Cell::free ? free : cell == Cell::occupied ? occupied : unknown);
  return message;
}

}  // namespace waitpoint::messages
