// SPDX-License-Identifier: BSD-3-Clause
// Call stacks of tasks as return addresses, and what a bug's report says of the run.
#pragma once

#include <cstddef>

#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

/// The caller's own call stack: writes at most `room` return addresses to `frames`, innermost first; returns how many.
std::size_t capture_call_stack(void** frames, std::size_t room);

/// Writes virtual time, task, seed and replay line to the error stream; signal handlers may call it.
void describe_run(const Task& task);

}  // namespace waitpoint::kernel
