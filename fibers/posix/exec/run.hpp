// SPDX-License-Identifier: BSD-3-Clause
// The run of `waitpoint exec`: the process's simulation, made before main(), which becomes its first task.
#pragma once

#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {

/// Runs the simulation, with `body` as its first thread, until the process exits.
[[noreturn]] void run_program(int (*body)(), const char* name);

}  // namespace waitpoint::posix
