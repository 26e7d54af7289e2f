// SPDX-License-Identifier: BSD-3-Clause
// A window of a run: all events before a given time, executed by one call from outside of tasks. It ends there, or
// earlier: paused, stopped, or for want of events. The next window continues the run as if there had been no end.
#pragma once

#include "core/time.hpp"
#include "fibers/kernel/run_state.hpp"
#include "fibers/switch/fiber_record.hpp"

namespace waitpoint::kernel {

class Scheduler;
struct Task;

struct RunWindow {
  Fiber main;                    ///< the caller of run_before()
  const void* thread = nullptr;  ///< that runs the tasks, by its thread pointer; null before the first
  Task* paused = nullptr;        ///< its event is the least, but beyond this window
  Task* culprit = nullptr;       ///< see culprit()
  RunState state = RunState::idle;
  StopCause cause = StopCause::none;

  /// Of a new run.
  void restart() {
    thread = nullptr;
    culprit = nullptr;
    state = RunState::idle;
    cause = StopCause::none;
  }
};

/// Executes all events before `until`. A run stays on the thread of its first call; other runs may be on others.
RunState run_before(Scheduler& scheduler, Time until);
StopCause stop_cause(const Scheduler& scheduler);
/// In a deadlock, a task of the cycle (`search.to` links its members); without progress, a spinning task; else null.
Task* culprit(const Scheduler& scheduler);
/// After a stop because no task but services remained: the next run_before() executes their events.
void go_on_after_end(Scheduler& scheduler);

/// Stops the run from within a task; run_before() returns at once.
void stop(Scheduler& scheduler, StopCause cause);
/// The same from a timer or a watch: no further event is executed.
void stop_between_events(Scheduler& scheduler, StopCause cause, Task& culprit);
/// From a task or a watch: run_before() returns before another event is executed, as if its window ended here.
void pause(Scheduler& scheduler);

/// The time of the next event; Time::max() if there is none.
Time next_event_time(const Scheduler& scheduler);

}  // namespace waitpoint::kernel
