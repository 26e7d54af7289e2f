// SPDX-License-Identifier: BSD-3-Clause
#include "modules/messages/readings.hpp"

#include <algorithm>
#include <limits>

#include "modules/messages/poses.hpp"

namespace waitpoint::messages {
namespace {

float range_or_infinity(float range_m, float range_max_m) {
  return range_m < range_max_m ? range_m : std::numeric_limits<float>::infinity();
}

}  // namespace

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

sensor_msgs::LaserScan message_of(const posters::LaserReading& scan, const std::string& frame) {
  const auto steps = static_cast<double>(std::max<std::size_t>(scan.range_m.size(), 1) - 1);
  sensor_msgs::LaserScan message;
  message.header = header_of(scan.date, frame);
  message.angle_min = static_cast<float>(scan.first_angle_rad);
  message.angle_max = static_cast<float>(scan.first_angle_rad + steps * scan.angle_step_rad);
  message.angle_increment = static_cast<float>(scan.angle_step_rad);
  message.range_max = static_cast<float>(scan.range_max_m);
  message.ranges.reserve(scan.range_m.size());
  for (const float range_m : scan.range_m) message.ranges.push_back(range_or_infinity(range_m, message.range_max));
  return message;
}

std::vector<sensor_msgs::LaserScan> messages_of(const world::LaserDescription& laser, const posters::LaserReading& scan,
                                                const std::string& frame) {
  std::vector messages{message_of(scan, frame)};
  messages[0].scan_time = static_cast<float>(laser.period.seconds());
  return messages;
}

std::vector<Mount> mounts_of(const world::SonarRingDescription& ring) {
  std::vector<Mount> mounts;
  for (std::uint32_t i = 0; i < ring.count; ++i)
    mounts.push_back({"_" + std::to_string(i), world::Sonars::mount(ring, i), ring.height_m});
  return mounts;
}

std::vector<sensor_msgs::Range> messages_of(const world::SonarRingDescription& ring,
                                            const world::Sonars::Reading& reading, const std::string& frame) {
  const std::vector<Mount> mounts = mounts_of(ring);
  std::vector<sensor_msgs::Range> messages;
  for (std::uint32_t i = 0; i < reading.range_m.size(); ++i) {
    if (!world::Sonars::fires(ring, i, reading.number - 1)) continue;
    sensor_msgs::Range& message = messages.emplace_back();
    message.header = header_of(reading.date, frame + mounts[i].suffix);
    message.radiation_type = constant<sensor_msgs::Range>("ULTRASOUND");
    message.field_of_view = static_cast<float>(2 * ring.half_cone_rad);
    message.min_range = static_cast<float>(ring.range_min_m);
    message.max_range = static_cast<float>(ring.range_max_m);
    message.range = range_or_infinity(static_cast<float>(reading.range_m[i]), message.max_range);
  }
  return messages;
}

sensor_msgs::BatteryState message_of(const world::Battery::Reading& battery, const std::string& frame) {
  sensor_msgs::BatteryState message;
  message.header = header_of(battery.date, frame);
  message.voltage = static_cast<float>(battery.volts);
  message.current = static_cast<float>(-battery.current_a);
  message.percentage = static_cast<float>(battery.charge);
  message.charge = message.capacity = message.design_capacity = std::numeric_limits<float>::quiet_NaN();
  message.power_supply_status = constant<sensor_msgs::BatteryState>("POWER_SUPPLY_STATUS_DISCHARGING");
  message.present = true;
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
