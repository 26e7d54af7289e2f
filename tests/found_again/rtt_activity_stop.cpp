// SPDX-License-Identifier: BSD-3-Clause
// Orocos RTT (docs/found.md): an activity is stopped while its thread begins.
#include <rtt/os/startstop.h>
#include <rtt/Activity.hpp>
#include <rtt/base/RunnableInterface.hpp>

#include <condition_variable>
#include <mutex>

class Waiting : public RTT::base::RunnableInterface {
 public:
  bool initialize() override { return true; }
  void finalize() override {}
  void step() override {}

  void loop() override {
    std::unique_lock<std::mutex> lock(mutex_);
    ++loops_;
    changed_.wait(lock, [&] { return broken_; });
    broken_ = false;
  }

  bool breakLoop() override {
    const std::lock_guard<std::mutex> lock(mutex_);
    broken_ = true;
    changed_.notify_one();
    return true;
  }

  int loops() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return loops_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool broken_ = false;
  int loops_ = 0;
};

int main(int argc, char** argv) {
  __os_init(argc, argv);
  {
    Waiting runnable;
    RTT::Activity activity(ORO_SCHED_OTHER, 0, 0, &runnable, "waiting");
    activity.start();
    runnable.loops();
    activity.stop();
  }
  __os_exit();
}
