// SPDX-License-Identifier: BSD-3-Clause
// geometry2, pull request 538: a message filter is destroyed while a transform arrives for which its message waits.
#include <geometry_msgs/PointStamped.h>
#include <ros/time.h>
#include <tf2/buffer_core.h>
#include <tf2_ros/message_filter.h>

#include <thread>

namespace {

geometry_msgs::TransformStamped transform(double seconds) {
  geometry_msgs::TransformStamped result;
  result.header.frame_id = "map";
  result.header.stamp = ros::Time(seconds);
  result.child_frame_id = "base";
  result.transform.rotation.w = 1;
  return result;
}

geometry_msgs::PointStampedPtr message(double seconds) {
  geometry_msgs::PointStampedPtr result(new geometry_msgs::PointStamped);
  result->header.frame_id = "base";
  result->header.stamp = ros::Time(seconds);
  return result;
}

}  // namespace

int main() {
  ros::Time::init();
  tf2::BufferCore buffer;
  buffer.setTransform(transform(1), "test");
  std::thread listener;
  {
    tf2_ros::MessageFilter<geometry_msgs::PointStamped> filter(buffer, "map", 2, nullptr);
    filter.add(message(2));
    listener = std::thread([&] { buffer.setTransform(transform(3), "test"); });
  }
  listener.join();
}
