// SPDX-License-Identifier: BSD-3-Clause
// The transform between two frames, and a message in one of them, at given times.
#pragma once

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/TransformStamped.h>

inline geometry_msgs::TransformStamped transform(double seconds) {
  geometry_msgs::TransformStamped result;
  result.header.frame_id = "map";
  result.header.stamp = ros::Time(seconds);
  result.child_frame_id = "base";
  result.transform.rotation.w = 1;
  return result;
}

inline geometry_msgs::PointStampedPtr message(double seconds) {
  geometry_msgs::PointStampedPtr result(new geometry_msgs::PointStamped);
  result->header.frame_id = "base";
  result->header.stamp = ros::Time(seconds);
  return result;
}
