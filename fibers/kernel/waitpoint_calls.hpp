// SPDX-License-Identifier: BSD-3-Clause
// The waitpoint, sleep and yield of the running task, for primitives: Algorithm 1, whose plain path is waitpoint.cpp.
//
// The functions are called by the running task, with its scheduler. False: the run is over, and the caller must leave
// its frames without blocking again. What is inline is the fast path (turn.hpp), and the switch of a task that leaves,
// which is in its caller's frame (fibers/switch/departure.hpp).
#pragma once

#include <cstdint>

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/turn.hpp"
#include "fibers/switch/departure.hpp"

namespace waitpoint::kernel {

/// The running task's waitpoint, if the path is open for `object` and events are not watched; otherwise false, with
/// nothing changed.
[[gnu::always_inline]] inline bool try_fast_waitpoint(Operation operation, Object& object) {
  if (__builtin_expect(object.epoch != turn.fast_epoch, 0)) return false;
  Task& task = *running;
  if (__builtin_expect(task.waitpoints >= waitpoints_max, 0)) return false;
  ++task.waitpoints;
  task.operation = operation;
  task.at = &object;
  count_event(task, operation, &object, turn.at);
  return true;
}

/// The plain path, for callers that have tried the fast path.
bool waitpoint_slow(Scheduler& scheduler, Operation operation, Object* object);

/// The running task's event is at its local time; returns when it is the least.
inline bool waitpoint(Scheduler& scheduler, Operation operation, Object* object) {
  if (object != nullptr && try_fast_waitpoint(operation, *object)) return true;
  return waitpoint_slow(scheduler, operation, object);
}

/// A waitpoint behind all tasks of this instant; in the seeded order, at a hashed place among them.
bool yield(Scheduler& scheduler);

// --- sleeping: in two parts, with the switch between them ---

/// The outcome of a call that does not depart.
inline Departure stay(Wake wake) { return Departure::none(static_cast<std::uintptr_t>(wake)); }
inline Wake wake_of(const Departure& none) { return static_cast<Wake>(none.outcome()); }

Departure start_sleep(Scheduler& scheduler, Time time);
/// The task's event is the one now executing: begins the next segment and executes the event.
bool end_waitpoint(Scheduler& scheduler, Task& task);

[[gnu::always_inline]] inline bool end_sleep(Scheduler& scheduler, const Arrival& arrival) {
  note_where_left(arrival);
  Task& task = *running;
  if (!turn.is_fast()) return end_waitpoint(scheduler, task);
  count_event(task, Operation::sleep, nullptr, turn.at);
  return true;
}

/// A waitpoint at `time`, or at the local time if that is later.
[[gnu::always_inline]] inline bool sleep_until(Scheduler& scheduler, Time time) {
  const Departure away = start_sleep(scheduler, time);
  return away.leads_away() ? end_sleep(scheduler, depart(away)) : wake_of(away) != Wake::unwinding;
}

// --- events without a waitpoint ---

bool read_clock_slow(Scheduler& scheduler, Time& local);

/// Reads the running task's clock. Not an event; but a read counts towards waitpoints_max, so that a task that polls
/// its clock yields to its ties.
inline bool read_clock(Scheduler& scheduler, Time& local) {
  Task& task = *running;
  if (__builtin_expect(!turn.holds_for(task), 0)) return read_clock_slow(scheduler, local);
  ++task.waitpoints;
  local = task.local_time;
  return true;
}

/// Adds words to the digest of the running task's robot.
void record_output(std::uint64_t name, std::uint64_t value);

}  // namespace waitpoint::kernel
