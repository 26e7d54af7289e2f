// SPDX-License-Identifier: BSD-3-Clause
// tf2 (docs/found.md): a message is added to a filter while the transform arrives for which it waits.
#include <ros/time.h>
#include <tf2/buffer_core.h>
#include <tf2_ros/message_filter.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "tests/found_again/tf2_messages.hpp"

int main() {
  using Message = geometry_msgs::PointStamped;
  ros::Time::init();
  tf2::BufferCore buffer;
  buffer.setTransform(transform(1), "test");
  std::atomic<int> calls = 0;
  tf2_ros::MessageFilter<Message> filter(buffer, "map", 2, nullptr);
  filter.registerCallback(boost::function<void(const Message::ConstPtr&)>([&](const Message::ConstPtr&) { ++calls; }));
  std::thread listener([&] { buffer.setTransform(transform(3), "test"); });
  filter.add(message(2));
  listener.join();
  buffer.setTransform(transform(4), "test");
  if (calls == 1) return 0;
  std::fprintf(stderr, "the message was not passed on\n");
  return EXIT_FAILURE;
}
