// SPDX-License-Identifier: BSD-3-Clause
// The making of tasks, and their ends: by themselves or in place. An ended run unwinds them (interruption.hpp).
#pragma once

#include "fibers/kernel/spawn_options.hpp"

namespace waitpoint::kernel {

class Scheduler;
struct Robot;
struct Task;

/// Makes a task of `robot` that starts at the caller's local time (outside of tasks: at the global time). Null if the
/// roster is full or no stack is free.
Task* spawn(Scheduler& scheduler, Robot& robot, const SpawnOptions& options, void (*entry)(void*), void* argument);

/// Ends `task`, which must not be the running one, without unwinding it; its objects become unowned. Its stack is kept
/// for free_stack().
void end_in_place(Task& task);
/// Frees the stack of a task that was ended in place, and its record with it.
void free_stack(const Task& task);
/// Ends the running task, which has passed the waitpoint of its end, without unwinding it.
[[noreturn]] void end_running_task();

}  // namespace waitpoint::kernel
