// SPDX-License-Identifier: BSD-3-Clause
// A task-local variable, the counterpart of thread_local. All fibers share one OS thread, hence one instance of a
// thread_local variable.
//
//   waitpoint::fiber_local<std::vector<int>> scratch;      // static, or a member
//   scratch->push_back(1);                                 // the running task's own, empty at first
//
// A value is made at its first use by a task, and destroyed when the task's function returns, throws or is unwound, in
// reverse order of construction.
#pragma once

#include "fibers/sync/local_values.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {

template <class T>
using fiber_local = sync::Local<T, sync::values_of_running_task>;

}  // namespace waitpoint
