// SPDX-License-Identifier: BSD-3-Clause
// What the code of a program's threads costs in virtual time. A program declares nothing: a segment of a thread, from
// one call that is simulated to the next, costs a time of an interval, or what the machine measures.
#pragma once

#include "fibers/clocks/task_clock.hpp"

namespace waitpoint::posix {

/// Part of a thread.
class ProgramClock {
 public:
  /// Of kind `fixed` or `interval` each segment costs from `least` to `greatest`, scaled; of the others see there.
  explicit ProgramClock(const kernel::ClockOptions& options);

  kernel::LocalClock& local() { return clock_; }

 private:
  kernel::TaskClock clock_;
};

}  // namespace waitpoint::posix
