// SPDX-License-Identifier: BSD-3-Clause
// Readings as messages of ROS.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Twist.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>

#include <string>

#include "modules/nodes/node_side.hpp"

namespace waitpoint::nodes {

geometry_msgs::TransformStamped transform(const ros::Time& stamp, const std::string& parent, const std::string& child,
                                          const Place& place);
geometry_msgs::PoseStamped pose_in(const ros::Time& stamp, const std::string& frame, const Place& place);
geometry_msgs::PoseWithCovarianceStamped pose_with_covariance(const ros::Time& stamp, const std::string& frame,
                                                              const PoseReading& pose);
/// The opposite.
PoseReading pose_reading(const geometry_msgs::PoseWithCovarianceStamped& message);
geometry_msgs::Twist twist_of(const Speeds& speeds);
sensor_msgs::LaserScan scan(const ros::Time& stamp, const LaserTopic& laser, const ScanReading& reading);
/// Of sonar number `sonar` of the ring.
sensor_msgs::Range range(const ros::Time& stamp, const SonarTopic& ring, std::size_t sonar, double range);
nav_msgs::Odometry odometry(const ros::Time& stamp, const std::string& frame, const std::string& child,
                            const Place& place, const std::array<double, 9>& covariance, const Speeds& speeds);
sensor_msgs::Imu imu(const ros::Time& stamp, const std::string& frame, const ImuReading& reading);
sensor_msgs::BatteryState battery(const ros::Time& stamp, const BatteryReading& reading);
nav_msgs::OccupancyGrid grid(const ros::Time& stamp, const std::string& frame, const GridValues& map);

}  // namespace waitpoint::nodes
