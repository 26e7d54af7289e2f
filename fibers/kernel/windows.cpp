// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/run_window.hpp"

#include "core/error.hpp"
#include "fibers/kernel/debugger.hpp"
#include "fibers/kernel/process_end.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"

namespace waitpoint::kernel {

// The frames of its tasks may hold addresses of the thread's variables.
void stay_on_thread(Scheduler& scheduler) {
  const void*& thread = scheduler.window.thread;
  if (thread == __builtin_thread_pointer()) return;
  WAITPOINT_REQUIRE(thread == nullptr, "a simulation is continued in another thread than the one that began to run it");
  thread = __builtin_thread_pointer();
  turn.digest = nullptr;  // of a previous run, whose robots may have had the same addresses
}

// Returns when the run is left; not if the process dies meanwhile.
static RunState run_from(Scheduler& scheduler, Fiber& first) {
  enter_run(scheduler, first);
  wait_if_dying();
  return scheduler.window.state;
}

RunState run_before(Scheduler& scheduler, Time until) {
  WAITPOINT_CHECK(running == nullptr, "run_before() is called from within a task");
  WAITPOINT_CHECK(!scheduler.interruption.is_unwinding, "run_before() is called after the run is over");
  stay_on_thread(scheduler);
  tell_debugger(scheduler);
  Agenda& agenda = scheduler.agenda;
  RunWindow& window = scheduler.window;
  agenda.until = until;
  scheduler.fast_path.allow_short_cuts(!scheduler.interruption.is_pending);
  if (window.cause != StopCause::none) return RunState::stopped;
  if (window.paused != nullptr) {
    Task& task = *window.paused;
    if (agenda.precedes(task, agenda.next_key())) {
      if (task.local_time >= agenda.until) return RunState::reached;
      window.paused = nullptr;
      return run_from(scheduler, resume(scheduler, task));
    }
    window.paused = nullptr;
    agenda.events.insert(task.event, agenda.key(task, task.local_time));
  }
  return run_from(scheduler, dispatch(scheduler));
}

// --- the ends of a window ---

Fiber& end_window(Scheduler& scheduler, RunState state) {
  RunWindow& window = scheduler.window;
  window.state = window.cause != StopCause::none ? RunState::stopped : state;
  running = nullptr;
  turn.close();
  return window.main;
}

// The event is not inserted into the list, to keep its place among its ties.
Fiber& wait_for_window(Scheduler& scheduler, Task& task) {
  task.state = TaskState::ready;
  scheduler.window.paused = &task;
  return end_window(scheduler, RunState::reached);
}

void leave_run(Scheduler& scheduler, RunState state) {
  scheduler.window.state = state;
  if (running == nullptr) return;
  Fiber& from = running->fiber;
  turn.close();
  switch_fibers(scheduler, from, end_window(scheduler, state));
}

void stop(Scheduler& scheduler, StopCause cause) {
  scheduler.window.cause = cause;
  leave_run(scheduler, RunState::stopped);
  if (scheduler.interruption.is_pending) answer_interrupt(scheduler);
}

void stop_between_events(Scheduler& scheduler, StopCause cause, Task& culprit) {
  scheduler.window.cause = cause;
  scheduler.window.culprit = &culprit;
  pause(scheduler);
}

void pause(Scheduler& scheduler) {
  scheduler.agenda.until = Time();  // no event is before it
  scheduler.fast_path.allow_short_cuts(false);
  if (running != nullptr) turn.close();
}

void go_on_after_end(Scheduler& scheduler) {
  WAITPOINT_CHECK(scheduler.window.cause == StopCause::ended, "a run goes on after its end without one");
  scheduler.window.cause = StopCause::none;
}

// --- queries ---

StopCause stop_cause(const Scheduler& scheduler) { return scheduler.window.cause; }
Task* culprit(const Scheduler& scheduler) { return scheduler.window.culprit; }

Time next_event_time(const Scheduler& scheduler) {
  if (const Task* const paused = scheduler.window.paused; paused != nullptr) return paused->local_time;
  return scheduler.agenda.next_time();
}

}  // namespace waitpoint::kernel
