// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/condition_variable.hpp"

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint {

void condition_variable::notify_all() {
  if (!sync::before_releasing(kernel::Operation::notify_all, object_)) return;
  if (object_.first_waiter != nullptr) kernel::note_transfer();
  kernel::wake_all(*kernel::running->scheduler, object_);
}

condition_variable::Start condition_variable::start_waiting(std::unique_lock<mutex>& lock) {
  if (!sync::before_blocking(kernel::Operation::wait, object_)) return Start::over;
  WAITPOINT_REQUIRE(lock.owns_lock() && lock.mutex()->core_.is_owned_by_caller(),
                    sync::about(object_, "a task waits on a condition variable without holding the lock"));
  WAITPOINT_REQUIRE(object_.first_waiter == nullptr || mutex_ == lock.mutex(),
                    sync::about(object_, "tasks wait on a condition variable with different mutexes"));
  mutex_ = lock.mutex();
  // An unlock without a waitpoint of its own.
  if (kernel::sanitizer::present) kernel::sanitizer::release(&lock.mutex()->core_.object());
  lock.mutex()->core_.release();
  return kernel::chooser(*kernel::running->scheduler).is_spurious(*kernel::running) ? Start::spurious : Start::waits;
}

}  // namespace waitpoint
