// SPDX-License-Identifier: BSD-3-Clause
// Call stacks of tasks as return addresses, and the description of the run in a bug's report.
#pragma once

#include <cstddef>

#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

/// Writes the caller's call stack to `frames`, at most `room` return addresses, innermost first; returns their number.
/// In a signal handler: the call stack that the signal interrupted. The address of its first frame is that of the
/// interrupted instruction plus 1, as if a call of one byte had been there.
std::size_t capture_call_stack(void** frames, std::size_t room);

/// Writes virtual time, task, codel, seed and replay line to the error stream; async-signal-safe.
void describe_run(const Task& task);

}  // namespace waitpoint::kernel
