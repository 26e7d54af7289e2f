// SPDX-License-Identifier: BSD-3-Clause
// Blocking on an object and waking its waiters, for primitives: Algorithm 2, whose plain path is waiting.cpp. What is
// inline is the switch of a task that blocks, in its caller's frame (fibers/switch/departure.hpp).
#pragma once

#include <cstdint>

#include "fibers/kernel/waitpoint_calls.hpp"

namespace waitpoint::kernel {

// --- blocking: by the running task, in two parts, with the switch between them ---

template <bool is_finite>
Departure start_block(Scheduler& scheduler, Object& object, Time deadline);
/// The task was woken or its wait timed out: begins the next segment and executes the event.
Wake end_block_slow(Scheduler& scheduler, Task& task, Object& object);

[[gnu::always_inline]] inline Wake end_block(Scheduler& scheduler, const Arrival& arrival, Object& object,
                                             bool is_finite) {
  note_where_left(arrival);
  Task& task = *running;
  if (!turn.is_fast()) return end_block_slow(scheduler, task, object);
  const Wake wake = is_finite ? task.wake : Wake::woken;
  count_event(task, wake == Wake::woken ? Operation::resume : Operation::timeout, &object, turn.at);
  return wake;
}

/// Blocks the running task on `object` until it is woken or until `deadline`; Time::max(): no timeout.
[[gnu::always_inline]] inline Wake block(Scheduler& scheduler, Object& object, Time deadline) {
  // Two instances, since the deadline is mostly a constant: the compiler chooses one, and no test is left.
  const bool is_finite = deadline != Time::max();
  const Departure away =
      is_finite ? start_block<true>(scheduler, object, deadline) : start_block<false>(scheduler, object, deadline);
  return away.leads_away() ? end_block(scheduler, depart(away), object, is_finite) : wake_of(away);
}

/// Blocks the running task on `object` until it is woken, without executing an event: for shared processors. False if
/// the run is over.
bool suspend(Object& object);

// --- waking ---

/// wake_one() of an object that has a waiter.
Task* wake_waiter(Scheduler& scheduler, Object& object);

/// From a task: wakes one waiter of `object`, selected by the chooser; null if there is none. The waiter's local time
/// becomes the global time.
inline Task* wake_one(Scheduler& scheduler, Object& object) {
  return object.first_waiter == nullptr ? nullptr : wake_waiter(scheduler, object);
}
void wake_all(Scheduler& scheduler, Object& object);
/// Wakes the first waiter, without a choice: for timers, which are not tasks.
Task* wake_first(Scheduler& scheduler, Object& object);
/// Wakes `task`, which must be blocked: for primitives that select the waiter themselves.
void wake(Scheduler& scheduler, Task& task);
/// Moves `task`, which must be blocked, to the waiters of `to`; its timeout is kept. Neither object may be held.
void move_waiter(Task& task, Object& to);

// --- the run that an object belongs to ---

/// Makes `object` belong to this run as the `number`-th object of `robot`, whose tasks are in another process.
void adopt_as(Scheduler& scheduler, Object& object, Robot& robot, std::uint32_t number);
/// The same as the next object of the running task's robot.
void adopt(Object& object);

/// Makes `object` belong to the running task's run. True if it did not yet: the primitive must then take its initial
/// state.
inline bool enter(Object& object) {
  if (__builtin_expect(object.epoch == turn.epoch, 1)) return false;
  adopt(object);
  return true;
}
/// True if the owners and waiters in `object` belong to this run.
bool has_entered(const Scheduler& scheduler, const Object& object);

}  // namespace waitpoint::kernel
