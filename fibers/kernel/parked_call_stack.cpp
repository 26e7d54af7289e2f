// SPDX-License-Identifier: BSD-3-Clause
//
// The call stack of a parked task: the task itself is resumed to write it, outside of virtual time.
#include "core/error.hpp"
#include "fibers/kernel/call_stack.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"

namespace waitpoint::kernel {

// Called by a resumed task while the run is interrupted: writes its call stack and switches back, as often as
// requested. Returns when its turn has come; false if the run is over.
bool Scheduler::answer_interrupt() {
  Task& task = *running;
  while (task.describe) {
    task.describe = false;
    frames_found_ = capture_call_stack(frames_, frames_room_);
    exit_run(state_);
  }
  return !unwinding_;
}

std::size_t Scheduler::call_stack(Task& task, void** frames, std::size_t room) {
  WAITPOINT_CHECK(running == nullptr && task.state != TaskState::ended,
                  "the call stack of a running or ended task is not available");
  if (task.sequence == 0) return 0;  // it never ran
  const TaskState state = task.state;
  const RunState run_state = state_;
  frames_ = frames;
  frames_room_ = room;
  const bool interrupted = interrupted_;
  task.describe = interrupted_ = true;
  fast_allowed_ = false;  // until the next run_before()
  enter_run(resume(task));
  interrupted_ = interrupted;
  task.state = state;
  state_ = run_state;
  return frames_found_;
}

}  // namespace waitpoint::kernel
