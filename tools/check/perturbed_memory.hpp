// SPDX-License-Identifier: BSD-3-Clause
// The parts of a perturbed process's memory that neither the C library nor the kernel perturb, and the check that the
// others are perturbed.
//
// The heap is perturbed by the preloaded library (surroundings/heap.cpp), addresses by the kernel. Stacks remain:
// main's, which is filled and moved, and each task's, which is filled when the task starts.
#pragma once

#include "fibers/kernel/task.hpp"
#include "tools/check/event_log.hpp"

namespace waitpoint::tools {

/// Calls `run` on a filled stack at another address.
void with_perturbed_stack(void (*run)(void*), void* argument);

/// Called by the running task on its stack: fills the unused part, 16 KiB at most.
void fill_stack(const kernel::Task& task);

/// Records clock and addresses in the log, for the perturbed process to compare.
void note_surroundings(SharedPage& page);

/// In the perturbed process: records if they differ.
void compare_surroundings(SharedPage& page);

}  // namespace waitpoint::tools
