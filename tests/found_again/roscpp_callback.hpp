// SPDX-License-Identifier: BSD-3-Clause
// A callback for ROS's queues that counts its calls under a mutex.
#pragma once

#include <ros/callback_queue_interface.h>

#include <mutex>

struct Counter {
  std::mutex mutex;
  int calls = 0;
};

class Counting : public ros::CallbackInterface {
 public:
  explicit Counting(Counter& counter) : counter_(counter) {}

  CallResult call() override {
    const std::lock_guard<std::mutex> lock(counter_.mutex);
    ++counter_.calls;
    return Success;
  }

 private:
  Counter& counter_;
};
