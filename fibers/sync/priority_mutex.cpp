// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/priority_mutex.hpp"

namespace waitpoint {

bool priority_mutex::take() {
  if (object_.owner != nullptr) return false;
  object_.owner = kernel::running;
  kernel::hold(*kernel::running, lock_);
  return true;
}

bool priority_mutex::try_lock() { return sync::before_blocking(kernel::Operation::try_lock, object_) && take(); }

bool priority_mutex::lock_before(Time deadline) {
  if (deadline <= now()) return try_lock();
  if (!sync::before_blocking(kernel::Operation::lock, object_)) return false;
  return take() || sync::block(object_, deadline);  // unlock() makes the woken one the owner
}

void priority_mutex::unlock() {
  if (!sync::before_releasing(kernel::Operation::unlock, object_)) return;
  WAITPOINT_CHECK(object_.owner == kernel::running, "a task unlocks a mutex that it does not hold");
  kernel::let_go(*kernel::running, lock_);
  // The owner goes first: whoever is woken must find nobody there.
  object_.owner = nullptr;
  object_.owner = kernel::wake_most_urgent(*kernel::running->scheduler, object_);
  if (object_.owner != nullptr) kernel::hold(*object_.owner, lock_);
}

}  // namespace waitpoint
