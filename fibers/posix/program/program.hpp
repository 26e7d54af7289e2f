// SPDX-License-Identifier: BSD-3-Clause
// The simulation that a program is: made before its main(), which becomes the first of its tasks.
#pragma once

#include "fibers/posix/program/record.hpp"
#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {

/// Null outside `waitpoint exec`; for guests it holds settings alone.
extern Record* record;

/// Whether programs are guests in a process of somebody else's (guests.hpp), whose own code is not simulated.
extern const bool has_host;
inline bool is_host_code() { return has_host && !is_simulated(); }

/// Runs `body` as the first thread of the simulation, and the others with it, until the process exits.
[[noreturn]] void run_program(int (*body)(), const char* name);

/// Whether the process is one of several programs, which its arguments name.
bool has_members();

/// The scheduler of a run that begins now, of no robot yet.
kernel::Scheduler& begin_run();
/// Until no thread can go on, or it is cut off: how it ended, which the record keeps.
Ending run_to_end(kernel::Scheduler& scheduler);
/// Ends the process after that, with `status` where it did not end by a failure, of which it tells.
[[noreturn]] void end_run(const kernel::Scheduler& scheduler, int status);

/// What the kernel calls in a thread with signals to be handled.
void deliver_signals(kernel::Task& task);

/// Ends the process for a reason of ours, told in one line.
[[noreturn]] void refuse(const char* reason);

}  // namespace waitpoint::posix
