// SPDX-License-Identifier: BSD-3-Clause
// The cost of a thread's own code in virtual time. Programs declare none: a segment, from one simulated call to the
// next, costs a time drawn from an interval, or its measured time.
#pragma once

#include "fibers/clocks/task_clock.hpp"

namespace waitpoint::posix {

/// Part of a thread.
class ProgramClock {
 public:
  /// For kinds `fixed` and `interval` each segment costs from `least` to `greatest`, scaled; for others see TaskClock.
  explicit ProgramClock(const kernel::ClockOptions& options);

  kernel::LocalClock& local() { return clock_; }

 private:
  kernel::TaskClock clock_;
};

}  // namespace waitpoint::posix
