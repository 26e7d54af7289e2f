// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/condition_variable.hpp"

namespace waitpoint {

void condition_variable::notify_one() {
  if (sync::before_releasing(kernel::Operation::notify_one, object_)) kernel::running->scheduler->wake_one(object_);
}

void condition_variable::notify_all() {
  if (sync::before_releasing(kernel::Operation::notify_all, object_)) kernel::running->scheduler->wake_all(object_);
}

bool condition_variable::wait_before(std::unique_lock<mutex>& lock, Time deadline) {
  WAITPOINT_CHECK(lock.owns_lock(), "a task waits on a condition variable without holding the lock");
  if (!sync::before_blocking(kernel::Operation::wait, object_)) return false;
  lock.mutex()->release();
  const bool woken = sync::block(object_, deadline);
  lock.mutex()->lock();
  return woken;
}

}  // namespace waitpoint
