// SPDX-License-Identifier: BSD-3-Clause
// The advance of a task's local virtual time while it computes.
//
// A segment is the code between two waitpoints. Its cost must be in the local virtual time before others can see any of
// its effects: a waitpoint ends the segment before it compares the task's event with the list, and begins the next
// segment when the task continues. A primitive's own code, between its waitpoint and its block, costs nothing.
//
//   --- waitpoint | begin ... computing ... now() ... computing ... end | waitpoint ---
//
// A task without a local clock has the fixed one: only costs declared by compute() advance its time, and its waitpoints
// make no call here. (The paper, II-B: "local virtual time, which depends only on its own execution flow".)
#pragma once

#include "core/error.hpp"
#include "core/time.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

/// The kernel's interface to a local clock, as a member of the clock's state. Serves one task. Functions may be null.
struct LocalClock {
  /// A segment begins.
  void (*begin)(LocalClock&, Task&) = nullptr;
  /// The segment ends: adds its cost to the task's local time, up to the next begin. A second call must add nothing.
  void (*end)(LocalClock&, Task&) = nullptr;
  /// The task declares a computation's cost within [`least`, `greatest`]. Null: declarations are ignored.
  void (*compute)(LocalClock&, Task&, Duration least, Duration greatest) = nullptr;
};

/// Sets the clock of `task`; null: the fixed one. It must live until the task ends or is given another.
void set_clock(Task& task, LocalClock* clock);

/// local_time() of a task with attention bits.
Time local_time_by_clock(Task& task);

/// The local virtual time of the running task, including the cost of its segment so far.
inline Time local_time(Task& task) {
  return __builtin_expect(task.attention != 0, 0) ? local_time_by_clock(task) : task.local_time;
}

/// The cost of the task's computation, within [`least`, `greatest`]: chosen, or replaced by the recorded one.
Duration choose_cost(Task& task, Duration least, Duration greatest);
/// `cost`, which does not follow from the run itself: recorded, or replaced by the recorded one (hooks.hpp, Durations).
Duration filter_cost(const Task& task, Duration cost);

/// Adds `cost` to the local time of the running task.
void consume(Task& task, Duration cost);

/// The running task waits for a device: adds `latency` to its local time, not scaled by any clock and without use of a
/// processor. The paper, II-B: "offsetting the logical time of the thread doing the access".
void access_hardware(Task& task, Duration latency);

/// Declares the cost of a computation of the running task: within [`least`, `greatest`], neither negative. Without a
/// clock the chooser decides; in the first-in-first-out order it is the greatest.
void compute(Task& task, Duration least, Duration greatest);

/// Declares a known cost.
inline void compute(Task& task, Duration cost) {
  if (__builtin_expect(task.attention != 0, 0)) return compute(task, cost, cost);
  WAITPOINT_REQUIRE(cost >= Duration(), "a computing time is negative");
  consume(task, cost);
}

}  // namespace waitpoint::kernel
