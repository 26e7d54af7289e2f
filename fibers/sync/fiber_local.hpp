// SPDX-License-Identifier: BSD-3-Clause
// A variable of which each task has its own: what thread_local is to threads. All fibers share one OS thread, so that
// thread_local itself is one variable for them all.
//
//   waitpoint::fiber_local<std::vector<int>> scratch;      // static, or a member
//   scratch->push_back(1);                                 // the running task's own, empty at first
//
// A value is made at the first use by its task, and destroyed when the task's function has returned or was left by an
// exception or by unwinding, the latest first.
#pragma once

#include "fibers/sync/local_values.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {

template <class T>
using fiber_local = sync::Local<T, sync::values_of_running_task>;

}  // namespace waitpoint
