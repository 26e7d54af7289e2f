// SPDX-License-Identifier: BSD-3-Clause
// The run of `waitpoint exec`: the simulation that a process is, made before main(), which becomes the first of its
// tasks.
#pragma once

#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {

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

/// The programs on the host's command line, FILE ARGUMENTS :: FILE ARGUMENTS, until all have ended.
[[noreturn]] void run_members(int argc, char** argv);

}  // namespace waitpoint::posix
