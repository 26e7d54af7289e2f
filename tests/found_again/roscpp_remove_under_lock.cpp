// SPDX-License-Identifier: BSD-3-Clause
// ros_comm, issue 1980: a callback is removed from its queue, as when a timer stops, under the lock that its call
// takes.
#include <ros/callback_queue.h>
#include <ros/time.h>

#include <thread>

#include "tests/found_again/roscpp_callback.hpp"

int main() {
  ros::Time::init();
  ros::CallbackQueue queue;
  Counter counter;
  queue.addCallback(boost::make_shared<Counting>(counter), 1);
  std::thread spinner([&] { queue.callAvailable(); });
  {
    const std::lock_guard<std::mutex> lock(counter.mutex);
    queue.removeByID(1);
  }
  spinner.join();
}
