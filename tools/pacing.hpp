// SPDX-License-Identifier: BSD-3-Clause
// Holds a run back to a multiple of the wall clock's speed. The wall clock is only waited for: nothing of it gets into
// the run.
#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

#include "core/time.hpp"

namespace waitpoint::tools {

class Pacing {
 public:
  /// `speed` simulated seconds a second; 0 does not hold back.
  explicit Pacing(double speed) : speed_(speed), start_(std::chrono::steady_clock::now()) {}

  /// Waits until the wall clock has come to `now`, or `stop()` says so: it is asked ten times a second.
  template <class Stop>
  void wait_for(Time now, Stop stop) const {
    if (speed_ <= 0) return;
    using Clock = std::chrono::steady_clock;
    const Clock::time_point due =
        start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(now.seconds() / speed_));
    while (Clock::now() < due && !stop())
      std::this_thread::sleep_until(std::min(due, Clock::now() + std::chrono::milliseconds(100)));
  }

 private:
  double speed_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace waitpoint::tools
