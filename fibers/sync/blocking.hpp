// SPDX-License-Identifier: BSD-3-Clause
// How primitives wait: the way from the standard library's vocabulary to the kernel's.
//
// When a run ends before its tasks do, their fibers are unwound: calls that can block then throw Unwind, which runs the
// destructors of all frames, and return at once if a destructor makes them. Calls that release never throw it.
#pragma once

#include <exception>

#include "core/time.hpp"
#include "fibers/kernel/local_clock.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/sync/unseen.hpp"

namespace waitpoint::sync {

/// Thrown through a task whose run is over. Derives from nothing: code under test should not catch it; if it does, the
/// next blocking call throws it again.
struct Unwind {};

inline kernel::Task& running_task() {
  WAITPOINT_CHECK(kernel::running != nullptr, "a simulated primitive is used outside a simulated task");
  return *kernel::running;
}

/// Called where the kernel said that the run is over.
inline void unwind() {
  if (std::uncaught_exceptions() == 0) throw Unwind();
}

// Parts of what follows in the library: what the kernel reads there is nothing of the user's.
bool waitpoint_unseen(kernel::Operation operation, kernel::Object& object);
bool block_unseen(kernel::Object& object, Time deadline);
kernel::Task* wake_one_unseen(kernel::Object& object);

/// A waitpoint before an operation that does not block; false when the run is over, and then nothing is to be done.
inline bool before_releasing(kernel::Operation operation, kernel::Object& object) {
#ifdef WAITPOINT_SEEN_BY_THREAD_SANITIZER
  return waitpoint_unseen(operation, object);
#else
  if (kernel::try_fast_waitpoint(operation, object)) return true;
  return running_task().scheduler->waitpoint_slow(operation, &object);
#endif
}

/// A waitpoint before an operation that may block. When the run is over it throws Unwind, or in a destructor that runs
/// then, returns false: nothing is to be done.
inline bool before_blocking(kernel::Operation operation, kernel::Object& object) {
  const bool goes_on = before_releasing(operation, object);
  if (!goes_on) unwind();
  return goes_on;
}

/// Wakes one of those that wait for `object`, of the chooser's choice; null if there is none.
inline kernel::Task* wake_one(kernel::Object& object) {
#ifdef WAITPOINT_SEEN_BY_THREAD_SANITIZER
  return wake_one_unseen(object);
#else
  return object.first_waiter == nullptr ? nullptr : kernel::running->scheduler->wake_one(object);
#endif
}

/// Blocks the running task on `object`; false if the deadline came first. Throws Unwind when the run is over.
[[gnu::always_inline]] inline bool block(kernel::Object& object, Time deadline = Time::max());
/// The same in the caller's frame, see departure.hpp.
[[gnu::always_inline]] inline bool block_here(kernel::Object& object, Time deadline) {
  {
    const Unseen unseen;
    ++object.users;
  }
  const kernel::Wake wake = kernel::running->scheduler->block(object, deadline);
  // A run that is over leaves its objects as they are: this one may be gone.
  if (__builtin_expect(wake == kernel::Wake::unwinding, 0)) {
    unwind();
    return false;
  }
  const Unseen unseen;
  --object.users;
  return wake == kernel::Wake::woken;
}

inline bool block(kernel::Object& object, Time deadline) {
#ifdef WAITPOINT_SEEN_BY_THREAD_SANITIZER
  return block_unseen(object, deadline);
#else
  return block_here(object, deadline);
#endif
}

}  // namespace waitpoint::sync
