// SPDX-License-Identifier: BSD-3-Clause
// ros_comm, pull request 1054: the first callback of an identifier is added while another thread calls what is in the
// queue.
#include <ros/callback_queue.h>
#include <ros/time.h>

#include <cstdio>
#include <cstdlib>
#include <thread>

#include "tests/found_again/roscpp_callback.hpp"

int main() {
  ros::Time::init();
  ros::CallbackQueue queue;
  Counter counter;
  std::thread source([&] { queue.addCallback(boost::make_shared<Counting>(counter), 1); });
  queue.callOne(ros::WallDuration(10));
  source.join();
  queue.callAvailable();
  if (counter.calls == 1) return 0;
  std::fprintf(stderr, "the callback was not called\n");
  return EXIT_FAILURE;
}
