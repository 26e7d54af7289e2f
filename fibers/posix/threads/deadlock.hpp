// SPDX-License-Identifier: BSD-3-Clause
// Reports of deadlocks among a program's threads.
#pragma once

#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::posix {

/// Writes to the error stream, for each thread, the object that it waits for and its holder. Objects have the names of
/// the program's variables, if it has symbols.
void report_deadlock(const kernel::Scheduler& scheduler);

/// `task` has just closed a cycle of waiting threads. True if the run continues with the others, as with threads of the
/// system; the cycle is reported at once. False where schedules are explored, and without other threads. If a timer of
/// the program is set, whose signal handler may end the wait, the run continues without a report.
bool continues_after_cycle(kernel::Task& task);

}  // namespace waitpoint::posix
