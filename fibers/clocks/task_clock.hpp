// SPDX-License-Identifier: BSD-3-Clause
// The implementations of the local clocks: see ClockOptions.
//
// Measured, chosen and counted costs pass through the scheduler's Durations before they are charged, so that a run that
// is not reproducible can be recorded and replayed.
#pragma once

#include "fibers/clocks/clock_options.hpp"
#include "fibers/kernel/local_clock.hpp"

namespace waitpoint::kernel {

/// The clock of one task.
struct TaskClock : LocalClock {
  /// A negative scale, cost or interval, or one with swapped ends, is a misuse.
  explicit TaskClock(const ClockOptions& options);

  ClockOptions options;
  std::int64_t started = 0;  ///< the reading of its source at the start of the segment: ns, or basic blocks
  bool runs = false;         ///< within a segment
};

}  // namespace waitpoint::kernel
