// SPDX-License-Identifier: BSD-3-Clause
// A visit to a parked task: a call on top of its stack, outside of virtual time.
#pragma once

#include <cstddef>

#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

/// The call, as a member of its arguments. It must return, and pass no waitpoint.
struct Visit {
  void (*act)(Visit&) = nullptr;
};

/// From outside of tasks: resumes `task`, which must have started, outside of virtual time. It calls `visit.act` on
/// top of its stack and is parked again.
void visit(Task& task, Visit& visit);

/// The call stack of `task`, which is not running, from outside of tasks: as capture_call_stack(); 0 if it never ran.
std::size_t call_stack(Task& task, void** frames, std::size_t room);

}  // namespace waitpoint::kernel
