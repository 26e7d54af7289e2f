// SPDX-License-Identifier: BSD-3-Clause
// Ownership, for locks with one holder: an object has its owner, and a task the list of its objects, for the search of
// the wait-for graph. Only these functions write them.
#pragma once

#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
// The list may name a local object of the caller: one that ends while it is owned stops the run.
#pragma GCC diagnostic ignored "-Wdangling-pointer"
#endif
/// Makes `task` the owner of `object`, which must have none.
inline void own(Object& object, Task& task) {
  object.owner = &task;
  // Mostly the link is unchanged since the last time. Without the write, disown() need not wait for it.
  if (__builtin_expect(object.next_held != task.held, 0)) object.next_held = task.held;
  task.held = &object;
}
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

/// Takes `object` from `owner`, which must own it.
inline void disown(Object& object, Task& owner) {
  // Locks are mostly released in the reverse order of their acquisition: the first link is the right one.
  Object** link = &owner.held;
  while (__builtin_expect(*link != &object, 0)) link = &(*link)->next_held;
  *link = object.next_held;
  object.owner = nullptr;
}
inline void disown(Object& object) { disown(object, *object.owner); }

}  // namespace waitpoint::kernel
