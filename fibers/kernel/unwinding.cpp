// SPDX-License-Identifier: BSD-3-Clause
#include "core/error.hpp"
#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"

namespace waitpoint::kernel {

bool is_unwinding(const Scheduler& scheduler) { return scheduler.interruption.is_unwinding; }

void unwind(Scheduler& scheduler) {
  WAITPOINT_CHECK(running == nullptr, "unwind() is called from within a task");
  scheduler.interruption.is_unwinding = scheduler.interruption.is_pending = true;
  scheduler.fast_path.forbid();
  scheduler.window.paused = nullptr;
  // Timers may outlive the run, so none may remain in its list. Objects with waiters are not touched: they may be
  // destroyed with the frames that own them, and are reinitialised in the next run.
  scheduler.agenda.clear();
  // Each resumed task ends and unlinks itself.
  const Roster& roster = scheduler.roster;
  if (roster.last_task() != nullptr) stay_on_thread(scheduler);
  while (Task* const task = roster.last_task()) {
    enter_run(scheduler, resume(scheduler, *task));
    WAITPOINT_CHECK(roster.last_task() != task, "a task continued although the run is over");
  }
}

// A task that keeps calling would never end: it is abandoned.
bool refuse() {
  if (++running->refusals > refusals_max) abandon();
  return false;
}

void abandon() {
  WAITPOINT_CHECK(running != nullptr && is_unwinding(*running->scheduler),
                  "a task is abandoned before the run is over");
  Task& task = *running;
  task.scheduler->roster.abandon(task);
  leave_run(*task.scheduler, RunState::stopped);
  bug(__FILE__, __LINE__, "control came back", "an abandoned task was entered");
}

}  // namespace waitpoint::kernel
