// SPDX-License-Identifier: BSD-3-Clause
// A small program in the style of a module, compiled once for simulated threads and once for real ones.
#pragma once

#include <cstdint>
#include <vector>

namespace waitpoint {

/// The results of the program: the same in simulation and in reality.
struct SameSourceOutcome {
  std::vector<int> consumed;             ///< by three consumers from three producers, sorted
  bool each_producer_in_order = true;    ///< in each consumer
  std::int64_t ticks = 0;                ///< of the periodic task, until it had 20
  std::vector<std::int64_t> first_dues;  ///< of its first ticks, as multiples of the period after the first
  std::int64_t ticks_while_busy = 0;     ///< during a sleep of five and a half periods
  bool timeouts_came = true;             ///< of mutex, semaphore and condition variable, none too early
  bool times_were_kept = true;           ///< no sleep was too short, time never decreased
  int threads_with_own_id = 0;

  friend bool operator==(const SameSourceOutcome&, const SameSourceOutcome&) = default;
};

/// Runs it; in simulation, within a task.
SameSourceOutcome run_same_source();

}  // namespace waitpoint
