// SPDX-License-Identifier: BSD-3-Clause
//
// The task itself is resumed, calls the visit's function, and switches back.
#include "fibers/kernel/visit.hpp"

#include <utility>

#include "core/error.hpp"
#include "fibers/kernel/call_stack.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"

namespace waitpoint::kernel {
namespace {

struct CallStackVisit : Visit {
  void** frames;
  std::size_t room;
  std::size_t found = 0;
};

void capture_in_task(Visit& visit) {
  auto& request = static_cast<CallStackVisit&>(visit);
  request.found = capture_call_stack(request.frames, request.room);
}

}  // namespace

bool answer_interrupt(Scheduler& scheduler) {
  Interruption& interruption = scheduler.interruption;
  while (Visit* const visit = std::exchange(interruption.visit, nullptr)) {
    visit->act(*visit);
    leave_run(scheduler, scheduler.window.state);
  }
  return !interruption.is_unwinding;
}

void visit(Task& task, Visit& visit) {
  WAITPOINT_CHECK(running == nullptr && task.state != TaskState::ended && task.sequence > 0,
                  "a task is visited that runs, has ended or never ran");
  Scheduler& scheduler = *task.scheduler;
  Interruption& interruption = scheduler.interruption;
  const TaskState state = task.state;
  const RunState run_state = scheduler.window.state;
  const bool was_pending = interruption.is_pending;
  interruption.visit = &visit;
  interruption.is_pending = true;
  scheduler.fast_path.allow_short_cuts(false);  // until the next run_before()
  enter_run(scheduler, resume(scheduler, task));
  WAITPOINT_CHECK(interruption.visit == nullptr, "a visited task did not call the visit's function");
  interruption.is_pending = was_pending;
  task.state = state;
  scheduler.window.state = run_state;
}

std::size_t call_stack(Task& task, void** frames, std::size_t room) {
  if (task.sequence == 0) return 0;
  CallStackVisit request{{capture_in_task}, frames, room};
  visit(task, request);
  return request.found;
}

}  // namespace waitpoint::kernel
