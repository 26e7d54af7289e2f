// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/messages.hpp"

#include <algorithm>
#include <limits>

#include "core/exact_math.hpp"

namespace waitpoint::nodes {
namespace {

std_msgs::Header header(const ros::Time& stamp, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = frame;
  return header;
}

geometry_msgs::Quaternion turn_of(double heading) {
  geometry_msgs::Quaternion turn;
  turn.z = exact::sin(heading / 2);
  turn.w = exact::cos(heading / 2);
  return turn;
}

geometry_msgs::Pose pose_of(const Place& place) {
  geometry_msgs::Pose message;
  message.position.x = place.x;
  message.position.y = place.y;
  message.position.z = place.z;
  message.orientation = turn_of(place.heading);
  return message;
}

// In ROS's order: x, y, z and the angles about them.
boost::array<double, 36> covariance_of(const std::array<double, 9>& covariance) {
  constexpr std::size_t places[] = {0, 1, 5}, rows = 6;
  boost::array<double, 36> all{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      all[rows * places[row] + places[column]] = covariance[3 * row + column];
  return all;
}

std::array<double, 9> plane_covariance_of(const boost::array<double, 36>& all) {
  constexpr std::size_t places[] = {0, 1, 5}, rows = 6;
  std::array<double, 9> covariance{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      covariance[3 * row + column] = all[rows * places[row] + places[column]];
  return covariance;
}

// As REP 117 has it.
float range_or_none(double range, double range_max) {
  return range < range_max ? static_cast<float>(range) : std::numeric_limits<float>::infinity();
}

}  // namespace

geometry_msgs::TransformStamped transform(const ros::Time& stamp, const std::string& parent, const std::string& child,
                                          const Place& place) {
  geometry_msgs::TransformStamped message;
  message.header = header(stamp, parent);
  message.child_frame_id = child;
  message.transform.translation.x = place.x;
  message.transform.translation.y = place.y;
  message.transform.translation.z = place.z;
  message.transform.rotation = turn_of(place.heading);
  return message;
}

geometry_msgs::PoseStamped pose_in(const ros::Time& stamp, const std::string& frame, const Place& place) {
  geometry_msgs::PoseStamped message;
  message.header = header(stamp, frame);
  message.pose = pose_of(place);
  return message;
}

geometry_msgs::PoseWithCovarianceStamped pose_with_covariance(const ros::Time& stamp, const std::string& frame,
                                                              const PoseReading& pose) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header = header(stamp, frame);
  message.pose.pose = pose_of(pose.place);
  message.pose.covariance = covariance_of(pose.covariance);
  return message;
}

PoseReading pose_reading(const geometry_msgs::PoseWithCovarianceStamped& message) {
  const geometry_msgs::Point& at = message.pose.pose.position;
  const geometry_msgs::Quaternion& turn = message.pose.pose.orientation;
  return {{at.x, at.y, 2 * exact::atan2(turn.z, turn.w), at.z}, plane_covariance_of(message.pose.covariance)};
}

geometry_msgs::Twist twist_of(const Speeds& speeds) {
  geometry_msgs::Twist twist;
  twist.linear.x = speeds.ahead;
  twist.linear.y = speeds.left;
  twist.linear.z = speeds.up;
  twist.angular.z = speeds.turn;
  return twist;
}

sensor_msgs::LaserScan scan(const ros::Time& stamp, const LaserTopic& laser, const ScanReading& reading) {
  sensor_msgs::LaserScan message;
  message.header = header(stamp, laser.frame);
  const auto steps = static_cast<double>(std::max<std::size_t>(reading.ranges.size(), 1) - 1);
  message.angle_min = static_cast<float>(reading.first_angle);
  message.angle_max = static_cast<float>(reading.first_angle + steps * reading.angle_step);
  message.angle_increment = static_cast<float>(reading.angle_step);
  message.scan_time = static_cast<float>(laser.period_s);
  message.range_max = static_cast<float>(laser.range_max);
  message.ranges.reserve(reading.ranges.size());
  for (const double range : reading.ranges) message.ranges.push_back(range_or_none(range, laser.range_max));
  return message;
}

sensor_msgs::Range range(const ros::Time& stamp, const SonarTopic& ring, std::size_t sonar, double range) {
  sensor_msgs::Range message;
  message.header = header(stamp, ring.frames[sonar]);
  message.radiation_type = sensor_msgs::Range::ULTRASOUND;
  message.field_of_view = static_cast<float>(ring.field_of_view);
  message.min_range = static_cast<float>(ring.range_min);
  message.max_range = static_cast<float>(ring.range_max);
  message.range = range_or_none(range, ring.range_max);
  return message;
}

nav_msgs::Odometry odometry(const ros::Time& stamp, const std::string& frame, const std::string& child,
                            const Place& place, const std::array<double, 9>& covariance, const Speeds& speeds) {
  nav_msgs::Odometry message;
  message.header = header(stamp, frame);
  message.child_frame_id = child;
  message.pose.pose = pose_of(place);
  message.pose.covariance = covariance_of(covariance);
  message.twist.twist = twist_of(speeds);
  return message;
}

sensor_msgs::Imu imu(const ros::Time& stamp, const std::string& frame, const ImuReading& reading) {
  sensor_msgs::Imu message;
  message.header = header(stamp, frame);
  message.orientation_covariance[0] = -1;  // none is measured
  message.angular_velocity.z = reading.turn;
  message.linear_acceleration.x = reading.ahead;
  message.linear_acceleration.y = reading.left;
  message.linear_acceleration.z = reading.up;
  return message;
}

sensor_msgs::BatteryState battery(const ros::Time& stamp, const BatteryReading& reading) {
  constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  sensor_msgs::BatteryState message;
  message.header = header(stamp, "");
  message.voltage = static_cast<float>(reading.volts);
  message.current = static_cast<float>(-reading.current_a);  // negative: it discharges
  message.percentage = static_cast<float>(reading.charge);
  message.charge = message.capacity = message.design_capacity = unknown;
  message.power_supply_status = sensor_msgs::BatteryState::POWER_SUPPLY_STATUS_DISCHARGING;
  message.present = 1;
  return message;
}

nav_msgs::OccupancyGrid grid(const ros::Time& stamp, const std::string& frame, const GridValues& map) {
  nav_msgs::OccupancyGrid message;
  message.header = header(stamp, frame);
  message.info.map_load_time = stamp;
  message.info.resolution = static_cast<float>(map.resolution);
  message.info.width = static_cast<std::uint32_t>(map.width);
  message.info.height = static_cast<std::uint32_t>(map.height);
  message.info.origin = pose_of(map.origin);
  message.data = map.cells;
  return message;
}

}  // namespace waitpoint::nodes
