// SPDX-License-Identifier: BSD-3-Clause
// The memory of a perturbed process: where it is not what the C library and the kernel make it, and what they did make
// of it.
//
// Its heap is the preloaded object's (surroundings/heap.cpp), its addresses are the kernel's choice. Left to do here
// are the stacks: main's, which is filled and moved, and each task's, which is filled when the task starts.
#pragma once

#include "fibers/kernel/task.hpp"
#include "tools/check/event_log.hpp"

namespace waitpoint::tools {

/// Calls `run` on a stack that is filled and lies elsewhere.
void with_perturbed_stack(void (*run)(void*), void* argument);

/// From the running task, on its stack: fills what it is going to use of it, 16 KiB at most.
void fill_stack(const kernel::Task& task);

/// Notes in the log what a perturbed process is to find otherwise: clock and addresses.
void note_surroundings(SharedPage& page);

/// In the perturbed process: notes whether it does.
void compare_surroundings(SharedPage& page);

}  // namespace waitpoint::tools
