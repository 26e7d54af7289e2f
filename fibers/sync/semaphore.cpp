// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/semaphore.hpp"

namespace waitpoint::sync {

inline void SemaphoreCore::refresh() {
  if (running_task().scheduler->enter(object_)) count_ = initial_;
}

void SemaphoreCore::release(std::ptrdiff_t units) {
  refresh();
  if (!before_releasing(kernel::Operation::release, object_)) return;
  WAITPOINT_CHECK(units >= 0, about(object_, "a semaphore is released by a negative number"));
  WAITPOINT_CHECK(units <= most_ - count_, about(object_, "a semaphore is released beyond its greatest count"));
  for (; units > 0 && object_.first_waiter != nullptr; --units) kernel::running->scheduler->wake_one(object_);
  count_ += units;
}

bool SemaphoreCore::take() {
  if (count_ == 0) return false;
  --count_;
  return true;
}

bool SemaphoreCore::try_acquire() {
  refresh();
  before_blocking(kernel::Operation::try_acquire, object_);
  return take();
}

bool SemaphoreCore::acquire_before(Time deadline) {
  refresh();
  before_blocking(kernel::Operation::acquire, object_);
  if (take()) return true;
  if (deadline <= kernel::running->local_time) return false;
  return block(object_, deadline);
}

}  // namespace waitpoint::sync
