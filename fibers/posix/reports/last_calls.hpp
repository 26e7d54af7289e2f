// SPDX-License-Identifier: BSD-3-Clause
// Where a failed run's threads were, with call stacks: the threads that no event can wake, or the one that crashes.
// Logged by each process in the family's memory.
#pragma once

#include <string>
#include <vector>

#include "fibers/kernel/task.hpp"
#include "fibers/sync/report/source_lines.hpp"

namespace waitpoint::posix {

struct LastCalls {
  std::string thread;  ///< "main", or "thread 1 is terminated by signal 11"
  sync::CodePlaces calls;
};

/// family::Part::last_calls.
struct LastCallsLog {
  std::vector<LastCalls> threads;
};

/// Logs those of all threads of this process, from outside of them.
void log_waits(const kernel::Scheduler& scheduler);
/// From now on the calls of a thread that crashes are logged.
void begin_crash_log();

}  // namespace waitpoint::posix
