// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/mutex_core.hpp"

namespace waitpoint::sync {

bool MutexCore::acquire_in_any_case(Time deadline) {
  if (object_.owner == nullptr) {
    kernel::own(object_, *kernel::running);
    return true;
  }
  // Who has no time to wait is no waiter, not even for this instant.
  if (deadline <= kernel::running->local_time) return false;
  return block(object_, deadline);  // release makes the woken one the owner
}

void MutexCore::release_in_any_case() {
  WAITPOINT_CHECK(is_owned_by_caller(), about(object_, "a task unlocks a mutex that it does not hold"));
  kernel::disown(object_);
  if (kernel::Task* next = kernel::running->scheduler->wake_one(object_); next != nullptr) kernel::own(object_, *next);
}

}  // namespace waitpoint::sync
