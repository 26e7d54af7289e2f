// SPDX-License-Identifier: BSD-3-Clause
// The run of `waitpoint exec`: the process's simulation, made before main(), which becomes its first task.
#pragma once

#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {

/// Runs the simulation, with `body` as its first thread, until the process exits.
[[noreturn]] void run_program(int (*body)(), const char* name);

/// True if the process is several programs, which its arguments name.
bool has_members();

/// Begins a run: its scheduler, which has no robot yet.
kernel::Scheduler& begin_run();
/// Runs until no thread can continue, or the time limit. The result is in the record too.
Ending run_to_end(kernel::Scheduler& scheduler);
/// Ends the process then, with `status` unless the run has failed; failures are reported.
[[noreturn]] void end_run(const kernel::Scheduler& scheduler, int status);

/// Runs the programs on the host's command line, FILE ARGUMENTS :: FILE ARGUMENTS, until all have ended.
[[noreturn]] void run_members(int argc, char** argv);

}  // namespace waitpoint::posix
