// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/semaphore.hpp"

#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"

namespace waitpoint::sync {

// The waitpoint before an operation; resets a semaphore at its first use in a run. False if the run is over.
bool SemaphoreCore::pass(kernel::Operation operation) {
  kernel::Scheduler& scheduler = *running_task().scheduler;
  if (kernel::enter(object_)) count_ = initial_;
  return kernel::waitpoint(scheduler, operation, &object_);
}

void SemaphoreCore::release_slow(std::ptrdiff_t units) {
  if (!pass(kernel::Operation::release)) return;
  WAITPOINT_REQUIRE(units >= 0, about(object_, "a semaphore is released by a negative number"));
  WAITPOINT_REQUIRE(units <= most_ - count_, about(object_, "a semaphore is released beyond its greatest count"));
  for (; units > 0 && object_.first_waiter != nullptr; --units) {
    kernel::wake_one(*kernel::running->scheduler, object_);
    kernel::note_transfer();
  }
  count_ += units;
}

bool SemaphoreCore::try_acquire() {
  if (!pass(kernel::Operation::try_acquire)) unwind();
  return take();
}

SemaphoreCore::Outcome SemaphoreCore::acquire_slow(Time deadline) {
  if (!pass(kernel::Operation::acquire)) unwind();
  return take_before(*kernel::running, deadline);
}

}  // namespace waitpoint::sync
