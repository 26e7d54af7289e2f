// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/mutex_core.hpp"

namespace waitpoint::sync {

// Locks are mostly given up in the reverse order of their taking: the first link is the right one.
void disown(kernel::Object& object) {
  kernel::Object** link = &object.owner->held;
  while (*link != &object) link = &(*link)->next_held;
  *link = object.next_held;
  object.owner = nullptr;
}

bool MutexCore::acquire(Time deadline) {
  if (object_.owner != nullptr) {
    // Who has no time to wait is no waiter, not even for this instant.
    if (deadline <= kernel::running->local_time) return false;
    return block(object_, deadline);  // release() makes the woken one the owner
  }
  own(object_, *kernel::running);
  return true;
}

void MutexCore::release() {
  WAITPOINT_CHECK(is_owned_by_caller(), about(object_, "a task unlocks a mutex that it does not hold"));
  disown(object_);
  if (kernel::Task* next = kernel::running->scheduler->wake_one(object_); next != nullptr) own(object_, *next);
}

}  // namespace waitpoint::sync
