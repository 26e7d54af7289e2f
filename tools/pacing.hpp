// SPDX-License-Identifier: BSD-3-Clause
// Holds a run back to a multiple of the wall clock's speed. The wall clock is only waited for: nothing of it gets into
// the run.
#pragma once

#include <chrono>
#include <thread>

#include "core/time.hpp"

namespace waitpoint::tools {

class Pacing {
 public:
  /// `speed` simulated seconds a second; 0 does not hold back.
  explicit Pacing(double speed) : speed_(speed), start_(std::chrono::steady_clock::now()) {}

  /// Waits until the wall clock has come to `now`.
  void wait_for(Time now) const {
    if (speed_ <= 0) return;
    std::this_thread::sleep_until(start_ + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                               std::chrono::duration<double>(now.seconds() / speed_)));
  }

 private:
  double speed_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace waitpoint::tools
