// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/semaphore.hpp"

namespace waitpoint::sync {

// The waitpoint before an operation, in the first use in a run that of a fresh semaphore; false when the run is over.
[[gnu::always_inline]] inline bool SemaphoreCore::pass(kernel::Task& task, kernel::Operation operation) {
  if (__builtin_expect(task.scheduler->waitpoint_at_once(task, operation, object_), 1)) return true;
  return pass_in_the_list(operation);
}

[[gnu::noinline]] bool SemaphoreCore::pass_in_the_list(kernel::Operation operation) {
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  if (scheduler.enter(object_)) count_ = initial_;
  return scheduler.waitpoint(operation, &object_);
}

inline bool SemaphoreCore::take() {
  if (count_ == 0) return false;
  --count_;
  return true;
}

void SemaphoreCore::release(std::ptrdiff_t units) {
  kernel::Task& task = running_task();
  if (!pass(task, kernel::Operation::release)) return;
  WAITPOINT_CHECK(units >= 0, about(object_, "a semaphore is released by a negative number"));
  WAITPOINT_CHECK(units <= most_ - count_, about(object_, "a semaphore is released beyond its greatest count"));
  for (; units > 0 && object_.first_waiter != nullptr; --units) task.scheduler->wake_one(object_);
  count_ += units;
}

bool SemaphoreCore::try_acquire() {
  if (!pass(running_task(), kernel::Operation::try_acquire)) unwind();
  return take();
}

SemaphoreCore::Outcome SemaphoreCore::acquire_now(Time deadline) {
  kernel::Task& task = running_task();
  if (!pass(task, kernel::Operation::acquire)) unwind();
  if (take()) return Outcome::acquired;
  return deadline <= task.local_time ? Outcome::too_late : Outcome::must_wait;
}

}  // namespace waitpoint::sync
