// SPDX-License-Identifier: BSD-3-Clause
// ros_comm, issue 2283: what a callback uses is destroyed when its removal from the queue has returned.
#include <ros/callback_queue.h>
#include <ros/time.h>

#include <memory>
#include <thread>

#include "tests/found_again/roscpp_callback.hpp"

int main() {
  ros::Time::init();
  ros::CallbackQueue queue;
  auto counter = std::make_unique<Counter>();
  queue.addCallback(boost::make_shared<Counting>(*counter), 1);
  std::thread spinner([&] { queue.callAvailable(); });
  queue.removeByID(1);
  counter.reset();
  spinner.join();
}
