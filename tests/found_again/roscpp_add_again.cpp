// SPDX-License-Identifier: BSD-3-Clause
// roscpp (docs/found.md): a callback is removed and another one added with its identifier, while a spinner that has
// taken both calls an earlier one.
#include <ros/callback_queue.h>
#include <ros/time.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>

class Earlier : public ros::CallbackInterface {
 public:
  CallResult call() override {
    called = true;
    const std::lock_guard<std::mutex> lock(mutex_);
    called = false;
    return Success;
  }

  std::atomic<bool> called = false;

 private:
  std::mutex mutex_;
};

class Removed : public ros::CallbackInterface {
 public:
  CallResult call() override {
    if (removed) late = true;
    return Success;
  }

  std::atomic<bool> removed = false;
  std::atomic<bool> late = false;
};

int main() {
  ros::Time::init();
  ros::CallbackQueue queue;
  const auto earlier = boost::make_shared<Earlier>();
  const auto callback = boost::make_shared<Removed>();
  queue.addCallback(earlier, 1);
  queue.addCallback(callback, 2);
  std::thread spinner([&] { queue.callAvailable(); });
  queue.removeByID(2);
  queue.addCallback(boost::make_shared<Removed>(), 2);
  // While the earlier one is called, the spinner cannot be in a call of the removed one.
  callback->removed = earlier->called.load();
  spinner.join();
  if (!callback->late) return 0;
  std::fprintf(stderr, "the callback was called after it had been removed\n");
  return EXIT_FAILURE;
}
