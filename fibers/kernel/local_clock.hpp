// SPDX-License-Identifier: BSD-3-Clause
// How a task's local virtual time moves while it computes.
//
// A segment is the code between two waitpoints. What it costs must be in the local virtual time before anything that it
// did can be seen by others: a waitpoint ends the segment before it looks for the task's place in the event list, and
// begins the next one when the task goes on. What primitives do between their waitpoint and their block costs nothing.
//
//   --- waitpoint | begin ... computing ... now() ... computing ... end | waitpoint ---
//
// A task without a local clock has the fixed one: its time moves by what it declares with compute(), and its waitpoints
// do not even call here. (The paper, II-B: "local virtual time, which depends only on its own execution flow".)
#pragma once

#include "core/error.hpp"
#include "core/time.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

/// A local clock as the kernel sees it: part of whatever keeps its state, and of one task only. Functions may be null.
struct LocalClock {
  /// The task goes on: a segment begins.
  void (*begin)(LocalClock&, Task&) = nullptr;
  /// The segment is over: the task's local time takes in what it consumed. Nothing more is consumed until the next
  /// begin; to be called twice must not count twice.
  void (*end)(LocalClock&, Task&) = nullptr;
  /// The task declares that what it computed costs at least `least` and at most `greatest`. Null: that does not count.
  void (*compute)(LocalClock&, Task&, Duration least, Duration greatest) = nullptr;
};

/// Gives `task` a clock; null: the fixed one. It must live until the task ends or has another.
void set_clock(Task& task, LocalClock* clock);

/// Out of line: local_time() of a task that needs attention.
Time local_time_by_clock(Task& task);

/// The local virtual time of the running task, with all that its segment has consumed so far.
inline Time local_time(Task& task) {
  return __builtin_expect(task.attention != 0, 0) ? local_time_by_clock(task) : task.local_time;
}

/// Moves the local time of the running task on by what it consumed.
void consume(Task& task, Duration cost);

/// The running task waits for a device: its local time moves on by `latency`, which no clock scales, and without use of
/// a processor. The paper, II-B: "offsetting the logical time of the thread doing the access".
void access_hardware(Task& task, Duration latency);

/// The running task declares that what it computed costs something from `least` to `greatest`, neither negative.
/// Without a clock the chooser decides: in the default order it is the greatest.
void compute(Task& task, Duration least, Duration greatest);

/// As above, with a cost that is known.
inline void compute(Task& task, Duration cost) {
  if (__builtin_expect(task.attention != 0, 0)) return compute(task, cost, cost);
  WAITPOINT_CHECK(cost >= Duration(), "computing takes no negative time");
  consume(task, cost);
}

}  // namespace waitpoint::kernel
