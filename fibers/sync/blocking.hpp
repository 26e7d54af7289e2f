// SPDX-License-Identifier: BSD-3-Clause
// The blocking calls of primitives, from the standard library's vocabulary to the kernel's.
//
// When a run ends before its tasks do, their fibers are unwound: blocking calls then throw Unwind, which runs the
// destructors of all frames; within a destructor they return at once instead. Releasing calls never throw it.
#pragma once

#include <exception>

#include "core/time.hpp"
#include "fibers/kernel/local_clock.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/sync/ignored_accesses.hpp"

namespace waitpoint::sync {

/// Unwinds a task whose run is over. It has no base class, so that code under test does not catch it by accident; if it
/// does, the next blocking call throws it again.
struct Unwind {};

inline kernel::Task& running_task() {
  WAITPOINT_REQUIRE(kernel::running != nullptr, "a simulated primitive is used outside a simulated task");
  return *kernel::running;
}

/// Makes `object` belong to the caller's run. True if it did not yet: the primitive must then take its initial state.
inline bool enter_run(kernel::Object& object) {
  (void)running_task();
  return kernel::enter(object);
}

/// Called when the kernel reports the end of the run.
inline void unwind() {
  if (std::uncaught_exceptions() == 0) throw Unwind();
}

// The out-of-line parts of the functions below, so that the kernel's accesses are not attributed to user code.
bool waitpoint_unseen(kernel::Operation operation, kernel::Object& object);
bool block_unseen(kernel::Object& object, Time deadline);
kernel::Task* wake_one_unseen(kernel::Object& object);

/// A waitpoint before an operation that does not block; false if the run is over: the operation is then skipped.
inline bool before_releasing(kernel::Operation operation, kernel::Object& object) {
#ifdef WAITPOINT_SEEN_BY_THREAD_SANITIZER
  return waitpoint_unseen(operation, object);
#else
  if (kernel::try_fast_waitpoint(operation, object)) return true;
  return kernel::waitpoint_slow(*running_task().scheduler, operation, &object);
#endif
}

/// A waitpoint before an operation that may block. If the run is over it throws Unwind, or, within a destructor,
/// returns false: the operation is then skipped.
inline bool before_blocking(kernel::Operation operation, kernel::Object& object) {
  const bool goes_on = before_releasing(operation, object);
  if (!goes_on) unwind();
  return goes_on;
}

/// Wakes one waiter of `object`, chosen by the chooser; null if there is none.
inline kernel::Task* wake_one(kernel::Object& object) {
#ifdef WAITPOINT_SEEN_BY_THREAD_SANITIZER
  return wake_one_unseen(object);
#else
  return object.first_waiter == nullptr ? nullptr : kernel::wake_one(*kernel::running->scheduler, object);
#endif
}

/// Blocks the running task on `object`; false if the deadline came first. Throws Unwind if the run is over.
[[gnu::always_inline]] inline bool block(kernel::Object& object, Time deadline = Time::max());
/// The same in the caller's frame, see departure.hpp.
[[gnu::always_inline]] inline bool block_here(kernel::Object& object, Time deadline) {
  {
    const IgnoredAccesses ignored_accesses;
    ++object.users;
  }
  const kernel::Wake wake = kernel::block(*kernel::running->scheduler, object, deadline);
  // At the end of a run objects may be destroyed before their waiters: do not touch this one.
  if (__builtin_expect(wake == kernel::Wake::unwinding, 0)) {
    unwind();
    return false;
  }
  const IgnoredAccesses ignored_accesses;
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
