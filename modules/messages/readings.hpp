// SPDX-License-Identifier: BSD-3-Clause
// Readings of sensors and values of modules as messages of ROS: for bags, and for topics of nodes. Each in the frame
// that is given, at its own date. A type of values has a message if it has a message_of() here.
#pragma once

#include <limits>
#include <string>

#include "core/occupancy_grid.hpp"
#include "modules/messages/geometry_msgs.hpp"
#include "modules/messages/nav_msgs.hpp"
#include "modules/messages/sensor_msgs.hpp"
#include "modules/posters/laser.hpp"
#include "modules/posters/position.hpp"
#include "world/sensors/types/gps.hpp"
#include "world/sensors/types/imu.hpp"

namespace waitpoint::messages {

geometry_msgs::TransformStamped transform_message(Time date, const std::string& parent, const std::string& child,
                                                  const Pose& pose, double z_m = 0);
geometry_msgs::PoseStamped pose_message(Time date, const std::string& frame, const Pose& pose, double z_m = 0);

geometry_msgs::PoseWithCovarianceStamped message_of(const posters::PositionEstimate& position,
                                                    const std::string& frame);
/// Of the robot's frame `child`.
nav_msgs::Odometry message_of(const posters::Odometry& odometry, const std::string& frame, const std::string& child);

/// A scan without its ranges. Those from `range_max_m` on are no echoes, and infinite in the message (REP 117).
sensor_msgs::LaserScan scan_message(Time date, const std::string& frame, double first_angle_rad, double angle_step_rad,
                                    std::size_t beams, double range_max_m);
inline float range_or_infinity(double range_m, double range_max_m) {
  return range_m < range_max_m ? static_cast<float>(range_m) : std::numeric_limits<float>::infinity();
}
sensor_msgs::LaserScan message_of(const posters::LaserReading& scan, const std::string& frame);

/// Rates and accelerations: no orientation is measured.
sensor_msgs::Imu message_of(const world::Imu::Reading& inertial, const std::string& frame);
/// Of the antenna.
geometry_msgs::PointStamped message_of(const world::Gps::Reading& fix, const std::string& frame);

nav_msgs::OccupancyGrid message_of(const OccupancyGrid& grid, Time date, const std::string& frame);

}  // namespace waitpoint::messages
