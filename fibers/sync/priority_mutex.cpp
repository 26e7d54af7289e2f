// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/priority_mutex.hpp"

#include "fibers/sync/mutex_core.hpp"

namespace waitpoint {

using kernel::Operation;
using kernel::running;

void priority_mutex::lock() {
  if (sync::before_blocking(Operation::lock, object_)) acquire(Time::max());
}

bool priority_mutex::lock_before(Time deadline) {
  if (!sync::before_blocking(deadline <= now() ? Operation::try_lock : Operation::lock, object_)) return true;
  WAITPOINT_REQUIRE(object_.owner != running, sync::about(object_, "a task tries to lock a mutex that it holds"));
  return acquire(deadline);
}

bool priority_mutex::acquire(Time deadline) {
  if (object_.owner != nullptr) {
    if (deadline <= running->local_time) return false;
    return sync::block(object_, deadline);  // unlock() made the woken task the owner
  }
  kernel::own(object_, *running);
  kernel::hold(*running, lock_);
  return true;
}

void priority_mutex::unlock() {
  if (!sync::before_releasing(Operation::unlock, object_)) return;
  WAITPOINT_REQUIRE(object_.owner == running, sync::about(object_, "a task unlocks a mutex that it does not hold"));
  kernel::let_go(*running, lock_);
  kernel::disown(object_);
  kernel::Task* const next = kernel::wake_most_urgent(*running->scheduler, object_);
  if (next == nullptr) return;
  kernel::own(object_, *next);
  kernel::hold(*next, lock_);
}

}  // namespace waitpoint
