// SPDX-License-Identifier: BSD-3-Clause
// geometry2, pull request 538: a message filter is destroyed while a transform arrives for which its message waits.
#include <ros/time.h>
#include <tf2/buffer_core.h>
#include <tf2_ros/message_filter.h>

#include <thread>

#include "tests/found_again/tf2_messages.hpp"

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
