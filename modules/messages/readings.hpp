// SPDX-License-Identifier: BSD-3-Clause
// Readings of sensors and values of modules as messages of ROS: for bags, and for topics of nodes. Each in the frame
// that is given, at its own date. A type of values has a message if it has a message_of() here.
#pragma once

#include <string>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "modules/messages/geometry_msgs.hpp"
#include "modules/messages/nav_msgs.hpp"
#include "modules/messages/sensor_msgs.hpp"
#include "modules/posters/laser.hpp"
#include "modules/posters/position.hpp"
#include "world/sensors/types/battery.hpp"
#include "world/sensors/types/gps.hpp"
#include "world/sensors/types/imu.hpp"
#include "world/sensors/types/sonars.hpp"

namespace waitpoint::messages {

geometry_msgs::TransformStamped transform_message(Time date, const std::string& parent, const std::string& child,
                                                  const Pose& pose, double z_m = 0);
geometry_msgs::PoseStamped pose_message(Time date, const std::string& frame, const Pose& pose, double z_m = 0);

geometry_msgs::PoseWithCovarianceStamped message_of(const posters::PositionEstimate& position,
                                                    const std::string& frame);
/// Of the robot's frame `child`.
nav_msgs::Odometry message_of(const posters::Odometry& odometry, const std::string& frame, const std::string& child);

/// Ranges from `range_max_m` on are no echoes, and infinite in the message (REP 117).
sensor_msgs::LaserScan message_of(const posters::LaserReading& scan, const std::string& frame);

/// The power that is drawn is negative.
sensor_msgs::BatteryState message_of(const world::Battery::Reading& battery, const std::string& frame);

/// Rates and accelerations: no orientation is measured.
sensor_msgs::Imu message_of(const world::Imu::Reading& inertial, const std::string& frame);
/// Of the antenna.
geometry_msgs::PointStamped message_of(const world::Gps::Reading& fix, const std::string& frame);

/// The messages of a sensor's reading: one, in the device's frame, unless the type has an overload below.
template <class Description, class Reading>
requires requires(const Reading& reading) { message_of(reading, std::string()); }
auto messages_of(const Description&, const Reading& reading, const std::string& frame) {
  return std::vector{message_of(reading, frame)};
}
std::vector<sensor_msgs::LaserScan> messages_of(const world::LaserDescription& laser, const posters::LaserReading& scan,
                                                const std::string& frame);
/// Of the sonars that have fired last, each in the frame FRAME_NUMBER.
std::vector<sensor_msgs::Range> messages_of(const world::SonarRingDescription& ring,
                                            const world::Sonars::Reading& reading, const std::string& frame);

/// The frame of a device, or of a part of it, on the body.
struct Mount {
  std::string suffix;  ///< of the device's frame
  Pose pose;
  double height_m = 0;
};
/// None of a sensor without a place on the body.
template <class Description>
std::vector<Mount> mounts_of(const Description& description) {
  if constexpr (requires { description.mount; }) return {{"", description.mount, description.height_m}};
  return {};
}
std::vector<Mount> mounts_of(const world::SonarRingDescription& ring);

nav_msgs::OccupancyGrid message_of(const OccupancyGrid& grid, Time date, const std::string& frame);

}  // namespace waitpoint::messages
