// SPDX-License-Identifier: BSD-3-Clause
//
// Visits to parked tasks: the task itself is resumed, calls the visit's function, and switches back.
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

// Called by a resumed task while the run is interrupted: serves visits until its turn has come. False if the run is
// over.
bool Scheduler::answer_interrupt() {
  while (Visit* const visit = std::exchange(visit_, nullptr)) {
    visit->act(*visit);
    exit_run(state_);
  }
  return !unwinding_;
}

void Scheduler::visit(Task& task, Visit& visit) {
  WAITPOINT_CHECK(running == nullptr && task.state != TaskState::ended && task.sequence > 0,
                  "a task is visited that runs, has ended or never ran");
  const TaskState state = task.state;
  const RunState run_state = state_;
  const bool interrupted = interrupted_;
  visit_ = &visit;
  interrupted_ = true;
  fast_allowed_ = false;  // until the next run_before()
  enter_run(resume(task));
  WAITPOINT_CHECK(visit_ == nullptr, "a visited task did not call the visit's function");
  interrupted_ = interrupted;
  task.state = state;
  state_ = run_state;
}

std::size_t call_stack(Task& task, void** frames, std::size_t room) {
  if (task.sequence == 0) return 0;
  CallStackVisit request{{capture_in_task}, frames, room};
  task.scheduler->visit(task, request);
  return request.found;
}

}  // namespace waitpoint::kernel
