// SPDX-License-Identifier: BSD-3-Clause
// The waiters of an object: an intrusive list of tasks, in the order of their blocking.
#pragma once

#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

inline void append_waiter(Object& object, Task& task) {
  task.blocked_on = &object;
  task.next_waiter = nullptr;
  task.previous_waiter = object.last_waiter;
  if (__builtin_expect(object.last_waiter == nullptr, 1))
    object.first_waiter = &task;
  else
    object.last_waiter->next_waiter = &task;
  object.last_waiter = &task;
}

/// `object` must have a waiter.
inline Task& remove_first_waiter(Object& object) {
  Task& task = *object.first_waiter;
  object.first_waiter = task.next_waiter;
  if (__builtin_expect(object.first_waiter == nullptr, 1))
    object.last_waiter = nullptr;
  else
    object.first_waiter->previous_waiter = nullptr;
  task.blocked_on = nullptr;
  return task;
}

/// `task` must be among an object's waiters.
inline void remove_waiter(Task& task) {
  Object& object = *task.blocked_on;
  (task.previous_waiter == nullptr ? object.first_waiter : task.previous_waiter->next_waiter) = task.next_waiter;
  (task.next_waiter == nullptr ? object.last_waiter : task.next_waiter->previous_waiter) = task.previous_waiter;
  task.blocked_on = nullptr;
}

}  // namespace waitpoint::kernel
