// SPDX-License-Identifier: BSD-3-Clause
// The local clocks that there are: see ClockOptions.
//
// What the machine measured, the chooser chose or the code was counted to cost goes through the scheduler's Durations
// before it counts, so that it can be recorded, and replayed where it was not reproducible.
#pragma once

#include "fibers/clocks/clock_options.hpp"
#include "fibers/kernel/local_clock.hpp"

namespace waitpoint::kernel {

/// The clock of one task.
struct TaskClock : LocalClock {
  /// A negative scale, cost or interval, or one whose ends are swapped, is a bug.
  explicit TaskClock(const ClockOptions& options);

  ClockOptions options;
  std::int64_t started = 0;  ///< what its source read when the segment began: ns, or basic blocks
  bool runs = false;         ///< within a segment
};

}  // namespace waitpoint::kernel
