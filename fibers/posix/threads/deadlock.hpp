// SPDX-License-Identifier: BSD-3-Clause
// Reports of runs that end since no thread continues.
#pragma once

#include "fibers/kernel/task.hpp"

namespace waitpoint::posix {

/// After a run that no thread can continue, or that makes no progress: writes the reason to the error stream, once for
/// all processes of the family, and a line for each thread (thread_states.hpp).
void report_end(const kernel::Scheduler& scheduler, const char* why);

/// `task` has just closed a cycle of waiting threads. True if the run continues without them, as with threads of the
/// system; the cycle is reported at once. False where schedules are explored, and if nothing else is left to happen: no
/// thread continues, no deadline or timer expires, and there is no other process. If a timer of the program is set,
/// whose signal handler may end the wait, the run continues without a report.
bool continues_after_cycle(kernel::Task& task);

}  // namespace waitpoint::posix
