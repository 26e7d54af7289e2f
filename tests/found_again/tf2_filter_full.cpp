// SPDX-License-Identifier: BSD-3-Clause
// geometry2, issue 91: a full message filter drops a message while a transform arrives for which the message waits.
#include <ros/time.h>
#include <tf2/buffer_core.h>
#include <tf2_ros/message_filter.h>

#include <thread>

#include "tests/found_again/tf2_messages.hpp"

int main() {
  ros::Time::init();
  tf2::BufferCore buffer;
  buffer.setTransform(transform(1), "test");
  tf2_ros::MessageFilter<geometry_msgs::PointStamped> filter(buffer, "map", 1, nullptr);
  filter.add(message(2));
  std::thread listener([&] { buffer.setTransform(transform(3), "test"); });
  filter.add(message(2.5));
  listener.join();
}
