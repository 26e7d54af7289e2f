// SPDX-License-Identifier: BSD-3-Clause
// The clock of simulated tasks, in the shape of std::chrono::steady_clock: now() is the caller's local virtual time.
#pragma once

#include <chrono>

#include "core/time.hpp"
#include "fibers/sync/blocking.hpp"

namespace waitpoint {

struct steady_clock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = std::chrono::nanoseconds;
  using time_point = std::chrono::time_point<steady_clock>;
  static constexpr bool is_steady = true;

  static time_point now() noexcept { return time_point(duration(kernel::local_time(sync::running_task()).ns())); }
};

/// The virtual time of a time point of the clock above.
inline Time to_time(steady_clock::time_point t) { return Time::from_ns(t.time_since_epoch().count()); }

/// The caller's local virtual time.
inline Time now() { return kernel::local_time(sync::running_task()); }

/// Tells the local clock that what the caller computed costs something from `least` to `greatest`: its local virtual
/// time moves on, and what it does next is seen by others that much later. Nothing happens in between: this is no
/// waitpoint. Costs that are negative or swapped are a bug.
inline void compute(Duration least, Duration greatest) { kernel::compute(sync::running_task(), least, greatest); }
inline void compute(Duration cost) { kernel::compute(sync::running_task(), cost); }

}  // namespace waitpoint
