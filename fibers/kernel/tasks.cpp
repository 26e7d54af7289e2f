// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/tasks.hpp"

#include <new>

#include "core/error.hpp"
#include "fibers/kernel/local_clock.hpp"
#include "fibers/kernel/processor.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"
#include "fibers/switch/fiber.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::kernel {

namespace {

void execute_start(Scheduler& scheduler, Task& task) {
  if (needs_attention(task) && !begin_segment(scheduler, task, Operation::start, nullptr)) return;
  execute(scheduler, task, Operation::start, nullptr);
}

[[noreturn]] void end_task(Scheduler& scheduler, Task& task) {
  if (task.seat != nullptr) vacate(task);
  scheduler.roster.remove(task);
  scheduler.ended = &task;
  task.fiber.ended = true;
  if (!scheduler.interruption.is_unwinding && scheduler.roster.count_end(task, scheduler.agenda.now)) {
    scheduler.window.cause = StopCause::ended;
    leave_run(scheduler, RunState::stopped);
  }
  if (scheduler.interruption.is_unwinding) leave_run(scheduler, RunState::stopped);
  turn.close();
  switch_fibers(scheduler, task.fiber, dispatch(scheduler));
  bug(__FILE__, __LINE__, "control came back", "an ended task was entered");
}

}  // namespace

// The first frame of a task.
void task_main(void* argument) {
  Task& task = *static_cast<Task*>(argument);
  Scheduler& scheduler = *task.scheduler;
  if (scheduler.ended != nullptr) reclaim_ended(scheduler);
  if (!scheduler.interruption.is_unwinding) execute_start(scheduler, task);
  task.entry(task.argument);
  waitpoint(scheduler, Operation::end, nullptr);
  end_task(scheduler, task);
}

Task* spawn(Scheduler& scheduler, Robot& robot, const SpawnOptions& options, void (*entry)(void*), void* argument) {
  const Time start = running != nullptr ? local_time(*running) : scheduler.agenda.now;
  if (scheduler.interruption.is_unwinding || scheduler.roster.is_full()) return nullptr;
  Stack stack;
  // Sanitizers enlarge frames, and compose a report on the stack of the reported task.
  const StackSize size = sanitizer::present && options.stack < StackSize::large ? StackSize::large : options.stack;
  StackArena& arena = scheduler.arena;
  if (!arena.take(size, stack) && (size == options.stack || !arena.take(options.stack, stack))) return nullptr;
  // The record is at the high end of the task's own stack: one page for both.
  char* top = stack.high - (sizeof(Task) + 63) / 64 * 64 - 64;
  Task& task = *new (top) Task();
  task.scheduler = &scheduler;
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

  scheduler.roster.add(task);
  scheduler.agenda.place(task, task.local_time);
  if (task.local_time <= scheduler.agenda.now) scheduler.fast_path.note_present_event(task.phase);
  return &task;
}

// --- ends ---

void reclaim_ended(Scheduler& scheduler) {
  const Task& ended = *scheduler.ended;
  const Stack stack = ended.fiber.stack;
  if (!StackArena::intact(stack)) report_overflow(ended);
  scheduler.ended = nullptr;
  scheduler.arena.give_back(stack);
}

void end_in_place(Task& task) {
  WAITPOINT_CHECK(&task != running && task.state != TaskState::running, "a running task is ended in place by another");
  Scheduler& scheduler = *task.scheduler;
  if (scheduler.window.paused == &task) scheduler.window.paused = nullptr;
  scheduler.agenda.remove(task);
  if (task.state == TaskState::blocked) remove_waiter(task);
  while (task.held != nullptr) {
    Object& object = *task.held;
    task.held = object.next_held;
    object.owner = nullptr;
  }
  if (task.seat != nullptr) vacate(task);
  scheduler.roster.remove(task);
  scheduler.roster.count_end(task, scheduler.agenda.now);
}

void free_stack(const Task& task) { task.scheduler->arena.give_back(Stack(task.fiber.stack)); }

void end_running_task() { end_task(*running->scheduler, *running); }

}  // namespace waitpoint::kernel
