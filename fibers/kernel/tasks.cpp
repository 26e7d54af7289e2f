// SPDX-License-Identifier: BSD-3-Clause
//
// The making and the ends of tasks: by themselves, in place, or unwound when the run is over.
#include <new>

#include "core/error.hpp"
#include "fibers/kernel/local_clock.hpp"
#include "fibers/kernel/processor.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"
#include "fibers/switch/fiber.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::kernel {

Task* Scheduler::spawn(Robot& robot, const SpawnOptions& options, void (*entry)(void*), void* argument) {
  const Time start = running != nullptr ? kernel::local_time(*running) : agenda_.now;
  if (unwinding_ || roster_.is_full()) return nullptr;
  Stack stack;
  // Sanitizers enlarge frames, and compose a report on the stack of the reported task.
  const StackSize size = sanitizer::present && options.stack < StackSize::large ? StackSize::large : options.stack;
  if (!arena_.take(size, stack) && (size == options.stack || !arena_.take(options.stack, stack))) return nullptr;
  // The record is at the high end of the task's own stack: one page for both.
  char* top = stack.high - (sizeof(Task) + 63) / 64 * 64 - 64;
  Task& task = *new (top) Task();
  task.scheduler = this;
  task.robot = &robot;
  task.id = running != nullptr ? child_id(running->id, running->children++) : child_id(robot.id, robot.children++);
  task.maker = running != nullptr ? running->id : 0;
  task.made_after = running != nullptr ? running->sequence : 0;
  task.local_time = start;
  task.entry = entry;
  task.argument = argument;
  task.phase = options.phase;
  task.service = options.service;
  set_clock(task, options.clock);
  if (options.seat != nullptr) set_seat(task, *options.seat);
  copy_name(task.name, options.name);
  prepare(task.fiber, stack, top, task_main, &task);
  if (sanitizer::present) sanitizer::name(task.fiber, task.name);

  roster_.add(task);
  agenda_.place(task, task.local_time);
  if (task.local_time <= agenda_.now) fast_path_.note_present_event(task.phase);
  return &task;
}

void Scheduler::task_main(void* argument) {
  Task& task = *static_cast<Task*>(argument);
  Scheduler& scheduler = *task.scheduler;
  if (scheduler.ended_ != nullptr) scheduler.reclaim_ended();
  if (!scheduler.unwinding_) scheduler.execute_start(task);
  task.entry(task.argument);
  scheduler.waitpoint(Operation::end, nullptr);
  scheduler.end_task(task);
}

void Scheduler::end_task(Task& task) {
  if (task.seat != nullptr) vacate(task);
  roster_.remove(task);
  ended_ = &task;
  task.fiber.ended = true;
  if (!unwinding_ && roster_.count_end(task, agenda_.now)) {
    cause_ = StopCause::ended;
    exit_run(RunState::stopped);
  }
  if (unwinding_) exit_run(RunState::stopped);
  fast_path_.close();
  switch_fibers(task.fiber, dispatch());
  bug(__FILE__, __LINE__, "control came back", "an ended task was entered");
}

void Scheduler::unwind() {
  WAITPOINT_CHECK(running == nullptr, "unwind() is called from within a task");
  unwinding_ = interrupted_ = true;
  fast_path_.forbid();
  fast_allowed_ = false;
  paused_ = nullptr;
  // Timers may outlive the run, so none may remain in its list. Objects with waiters are not touched: they may be
  // destroyed with the frames that own them, and are reinitialised in the next run.
  agenda_.clear();
  // Each resumed task ends and unlinks itself.
  if (roster_.last_task() != nullptr) stay_on_thread();
  while (Task* const task = roster_.last_task()) {
    enter_run(resume(*task));
    WAITPOINT_CHECK(roster_.last_task() != task, "a task continued although the run is over");
  }
}

void Scheduler::end_in_place(Task& task) {
  WAITPOINT_CHECK(&task != running && task.state != TaskState::running, "a running task is ended in place by another");
  if (paused_ == &task) paused_ = nullptr;
  agenda_.remove(task);
  if (task.state == TaskState::blocked) remove_waiter(task);
  while (task.held != nullptr) {
    Object& object = *task.held;
    task.held = object.next_held;
    object.owner = nullptr;
  }
  if (task.seat != nullptr) vacate(task);
  roster_.remove(task);
  roster_.count_end(task, agenda_.now);
}

void Scheduler::continue_as(std::uint64_t id) {
  Task& task = *running;
  WAITPOINT_CHECK(first_task() == &task && task.next == nullptr, "a child has tasks of its parent's");
  task.maker = task.id;
  task.made_after = task.sequence;
  task.id = id;
  task.sequence = task.children = 0;
  fast_path_.close();
  hash_events_of(*task.robot);
}

void Scheduler::end_running_task() { end_task(*running); }

// Refuses a call after the end of the run. A task that keeps calling would never end: it is abandoned.
bool Scheduler::refuse() {
  if (++running->refusals > refusals_max) abandon();
  return false;
}

void Scheduler::abandon() {
  WAITPOINT_CHECK(unwinding_ && running != nullptr, "a task is abandoned before the run is over");
  Task& task = *running;
  roster_.abandon(task);
  exit_run(RunState::stopped);
  bug(__FILE__, __LINE__, "control came back", "an abandoned task was entered");
}

}  // namespace waitpoint::kernel
