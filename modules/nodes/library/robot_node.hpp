// SPDX-License-Identifier: BSD-3-Clause
// The topics of one robot.
#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include <optional>
#include <vector>

#include "modules/nodes/node_side.hpp"

namespace waitpoint::nodes {

class RobotNode {
 public:
  /// Names of topics and frames as in `topics`, which is copied.
  explicit RobotNode(const RobotTopics& topics);

  /// `stamp` is that of `now_ns`; transforms are added to `tf`.
  void publish(std::int64_t now_ns, const ros::Time& stamp, const RobotReadings& readings, tf2_msgs::TFMessage& tf);
  /// The transforms to its sensors.
  void add_fixed(const ros::Time& stamp, tf2_msgs::TFMessage& tf) const;
  void send_goal(const ros::Time& stamp, const Place& goal);
  /// Its start, for nodes that localise it.
  void send_start(const ros::Time& stamp);
  bool has_driver() const { return goal_.getNumSubscribers() > 0; }
  /// Dates are since `begin`.
  std::optional<PublishedPose> take_pose(const ros::Time& begin);
  std::optional<Command> take_command() { return std::exchange(command_, std::nullopt); }

 private:
  void take(const geometry_msgs::Twist& twist);
  void publish(const ros::Time& stamp, const PosterReading& reading);
  void add_transforms(const ros::Time& stamp, const RobotReadings& readings, tf2_msgs::TFMessage& tf) const;

  RobotTopics topics_;
  ros::NodeHandle node_;
  std::vector<ros::Publisher> scans_, sonars_;
  ros::Publisher odometry_, truth_, imu_, battery_, goal_, start_;
  std::vector<ros::Publisher> posters_;  // none before the first value
  ros::Subscriber drive_, pose_;
  geometry_msgs::PoseWithCovarianceStamped::ConstPtr taken_pose_;  // the newest
  std::optional<Command> command_;
};

}  // namespace waitpoint::nodes
