// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/shared_mutex.hpp"

#include <algorithm>

#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/sync/mutex_core.hpp"

namespace waitpoint {

using kernel::Operation;
using kernel::running;
using kernel::Task;

// Drops the state left by another run.
void shared_mutex::refresh() {
  if (sync::enter_run(object_)) readers_.clear();
}

bool shared_mutex::is_reader(const Task& task) const {
  return task.held_shared != 0 && std::find(readers_.begin(), readers_.end(), &task) != readers_.end();
}

// --- writers ---

void shared_mutex::lock() {
  refresh();
  if (sync::before_blocking(Operation::lock, object_)) acquire(Time::max());
}

bool shared_mutex::lock_before(Time deadline) {
  refresh();
  if (!sync::before_blocking(deadline <= now() ? Operation::try_lock : Operation::lock, object_)) return true;
  WAITPOINT_REQUIRE(object_.owner != running && !is_reader(*running),
                    sync::about(object_, "a task tries to lock a shared mutex that it holds"));
  return acquire(deadline);
}

bool shared_mutex::acquire(Time deadline) {
  if (object_.owner == nullptr && readers_.empty()) {
    kernel::own(object_, *running);
    return true;
  }
  if (deadline <= running->local_time) return false;
  if (sync::block(object_, deadline)) return true;
  if (kernel::is_unwinding(*running->scheduler)) return false;
  // The readers that waited because of this writer.
  const Task* waiter = object_.first_waiter;
  while (waiter != nullptr && waiter->shared_wait) waiter = waiter->next_waiter;
  if (waiter == nullptr && object_.owner == nullptr) admit_readers();
  return false;
}

void shared_mutex::unlock() {
  if (!sync::before_releasing(Operation::unlock, object_)) return;
  WAITPOINT_REQUIRE(object_.owner == running,
                    sync::about(object_, "a task unlocks a shared mutex that it does not hold as a writer"));
  kernel::disown(object_);
  hand_over(true);
}

// --- readers ---

void shared_mutex::lock_shared() {
  refresh();
  if (!sync::before_blocking(Operation::lock_shared, object_)) return;
  WAITPOINT_REQUIRE(!is_reader(*running), sync::about(object_, "a reader locks a shared mutex again"));
  acquire_shared(Time::max());
}

bool shared_mutex::lock_shared_before(Time deadline) {
  refresh();
  if (!sync::before_blocking(deadline <= now() ? Operation::try_lock_shared : Operation::lock_shared, object_))
    return true;
  WAITPOINT_REQUIRE(object_.owner != running && !is_reader(*running),
                    sync::about(object_, "a task tries to lock a shared mutex that it holds"));
  return acquire_shared(deadline);
}

// If no writer holds the lock, each waiter is a writer or waits behind one.
bool shared_mutex::acquire_shared(Time deadline) {
  if (object_.owner == nullptr && object_.first_waiter == nullptr) {
    add_reader(*running);
    return true;
  }
  if (deadline <= running->local_time) return false;
  running->shared_wait = true;
  const bool admitted = sync::block(object_, deadline);
  running->shared_wait = false;
  return admitted;
}

void shared_mutex::unlock_shared() {
  refresh();
  if (!sync::before_releasing(Operation::unlock_shared, object_)) return;
  WAITPOINT_REQUIRE(is_reader(*running),
                    sync::about(object_, "a task unlocks a shared mutex that it does not hold as a reader"));
  remove_reader(*running);
  if (readers_.empty()) hand_over(false);
}

void shared_mutex::add_reader(Task& task) {
  readers_.push_back(&task);
  object_.holders = readers_.data();
  ++object_.holder_count;
  ++task.held_shared;
}

void shared_mutex::remove_reader(Task& task) {
  readers_.erase(std::find(readers_.begin(), readers_.end(), &task));
  --object_.holder_count;
  --task.held_shared;
}

// --- hand-over ---

void shared_mutex::admit_readers() {
  for (Task* waiter = object_.first_waiter; waiter != nullptr;) {
    Task& task = *waiter;
    waiter = waiter->next_waiter;
    if (!task.shared_wait) continue;
    add_reader(task);
    kernel::wake(*running->scheduler, task);
  }
}

// The lock is free. The candidates are each writer, and all readers as one.
void shared_mutex::hand_over(bool readers_first) {
  std::uint32_t writers = 0, readers = 0;
  for (const Task* waiter = object_.first_waiter; waiter != nullptr; waiter = waiter->next_waiter)
    ++(waiter->shared_wait ? readers : writers);
  if (writers + readers == 0) return;
  const bool with_readers = readers != 0;
  std::uint32_t chosen = kernel::chooser(*running->scheduler).waiter(*running, writers + with_readers);
  if (with_readers && chosen == (readers_first ? 0 : writers)) return admit_readers();
  if (with_readers && readers_first) --chosen;
  Task* writer = object_.first_waiter;
  while (writer->shared_wait || chosen-- != 0) writer = writer->next_waiter;
  kernel::wake(*running->scheduler, *writer);
  kernel::own(object_, *writer);
}

}  // namespace waitpoint
