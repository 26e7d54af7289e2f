// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/mutex.hpp"

namespace waitpoint {

bool mutex::acquire(Time deadline) {
  if (object_.owner != nullptr) return sync::block(object_, deadline);  // release() makes the woken one the owner
  object_.owner = kernel::running;
  return true;
}

void mutex::release() {
  WAITPOINT_CHECK(object_.owner == kernel::running, "a task unlocks a mutex that it does not hold");
  // The owner goes first: whoever is woken must find nobody there.
  object_.owner = nullptr;
  object_.owner = kernel::running->scheduler->wake_one(object_);
}

bool timed_mutex::lock_before(Time deadline) {
  if (deadline <= now()) return try_lock();
  sync::before_blocking(kernel::Operation::lock, object());
  return acquire(deadline);
}

}  // namespace waitpoint
