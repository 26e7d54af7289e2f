// SPDX-License-Identifier: BSD-3-Clause
// Who holds what, for locks of one holder: an object knows its owner, and what a task owns hangs in a list in it, so
// that cycles of owners are found. Both are written here alone.
#pragma once

#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

/// Makes `task` the owner of `object`, which nobody owns.
inline void own(Object& object, Task& task) {
  object.owner = &task;
  // Mostly the link is as it was the last time. Not written, it need not be waited for when the object is given up.
  if (__builtin_expect(object.next_held != task.held, 0)) object.next_held = task.held;
  task.held = &object;
}

/// Takes `object` from `owner`, who owns it.
inline void disown(Object& object, Task& owner) {
  // Locks are mostly given up in the reverse order of their taking: the first link is the right one.
  Object** link = &owner.held;
  while (__builtin_expect(*link != &object, 0)) link = &(*link)->next_held;
  *link = object.next_held;
  object.owner = nullptr;
}
inline void disown(Object& object) { disown(object, *object.owner); }

}  // namespace waitpoint::kernel
