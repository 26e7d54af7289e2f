// SPDX-License-Identifier: BSD-3-Clause
//
// The ends of tasks: their own, and that of a run which is over before them.
#include "core/error.hpp"
#include "fibers/kernel/processor.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"

namespace waitpoint::kernel {

void Scheduler::task_main(void* argument) {
  Task& task = *static_cast<Task*>(argument);
  Scheduler& scheduler = *task.scheduler;
  if (scheduler.ended_ != nullptr) scheduler.reclaim_ended();
  if (!scheduler.unwinding_) scheduler.begin(task);
  task.entry(task.argument);
  scheduler.waitpoint(Operation::end, nullptr);
  scheduler.end_task(task);
}

void Scheduler::unlink(Task& task) {
  task.state = TaskState::ended;
  (task.previous == nullptr ? first_task_ : task.previous->next) = task.next;
  (task.next == nullptr ? last_task_ : task.next->previous) = task.previous;
  --tasks_;
}

// Of a task that is no service: whether it was the last of all.
bool Scheduler::count_end(const Task& task) {
  if (--task.robot->live_tasks == 0) {
    task.robot->ended = true;
    task.robot->lane = &unheard_;
    task.robot->end_time = agenda_.now;
  }
  return --live_tasks_ == 0;
}

void Scheduler::end_task(Task& task) {
  if (task.seat != nullptr) vacate(task);
  unlink(task);
  ended_ = &task;
  task.fiber.ended = true;
  if (!task.service && !unwinding_ && count_end(task)) {
    cause_ = StopCause::ended;
    leave_to_main(RunState::stopped);
  }
  if (unwinding_) leave_to_main(RunState::stopped);
  leave_for_next(task);
  bug(__FILE__, __LINE__, "control came back", "an ended task was entered");
}

void Scheduler::unwind() {
  WAITPOINT_CHECK(running == nullptr, "unwind() is called from within a task");
  unwinding_ = interrupted_ = true;
  free_pass_.forbid();
  ordinary_ = false;
  paused_ = nullptr;
  // Timers may outlive the run: they must not find themselves in its list. Objects that tasks wait for are not touched:
  // they may be gone with the frames that own them, and read as fresh in the next run.
  agenda_.clear();
  // Each entry ends its task, which unlinks it.
  while (last_task_ != nullptr) {
    Task& task = *last_task_;
    switch_to(task);
    WAITPOINT_CHECK(last_task_ != &task, "a task went on although the run is over");
  }
}

void Scheduler::end_in_place(Task& task) {
  WAITPOINT_CHECK(&task != running && task.state != TaskState::running, "a task that runs is ended by another");
  if (paused_ == &task) paused_ = nullptr;
  agenda_.remove(task);
  if (task.state == TaskState::blocked) remove_waiter(task);
  while (task.held != nullptr) {
    Object& object = *task.held;
    task.held = object.next_held;
    object.owner = nullptr;
  }
  if (task.seat != nullptr) vacate(task);
  unlink(task);
  if (!task.service) count_end(task);
}

void Scheduler::keep_running_task_only() {
  agenda_.clear_present();
  for (Task *task = first_task_, *next = nullptr; task != nullptr; task = next) {
    next = task->next;
    if (task != running) end_in_place(*task);
  }
}

void Scheduler::end_running_task() { end_task(*running); }

// A task that goes on calling although every call is refused would never end.
bool Scheduler::refuse() {
  if (++running->refusals > refusals_max) abandon();
  return false;
}

void Scheduler::abandon() {
  WAITPOINT_CHECK(unwinding_ && running != nullptr, "a task is abandoned while the run goes on");
  Task& task = *running;
  unlink(task);
  task.next = first_abandoned_;
  first_abandoned_ = &task;
  leave_to_main(RunState::stopped);
  bug(__FILE__, __LINE__, "control came back", "an abandoned task was entered");
}

}  // namespace waitpoint::kernel
