// SPDX-License-Identifier: BSD-3-Clause
// Steps shared by the scheduler's source files, and included by them only; those of every event are inline. A function
// that returns a fiber has made its task the running one: the caller must switch to it at once.
#pragma once

#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/fetch_ahead.hpp"
#include "fibers/kernel/processor.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/waiters.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/switch/fiber.hpp"
#include "fibers/switch/runtime_state.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::kernel {

// --- waitpoint.cpp, explored.cpp: the least event ---

/// Takes out events in order: calls the actions of timers and messages, and resumes the task of the first other event.
/// At the end of the window or of the run, the main fiber.
Fiber& dispatch(Scheduler& scheduler);
Fiber& dispatch_explored(Scheduler& scheduler);
Departure sleep_slow(Scheduler& scheduler, Time time);
/// The task continues with `operation`. False if the run is over.
bool begin_segment(Scheduler& scheduler, Task& task, Operation operation, Object* object);

// --- waiting.cpp ---

Departure block_slow(Scheduler& scheduler, Object& object, Time deadline);
Task* wake_one_slow(Scheduler& scheduler, Object& object);

// --- fast_calls.cpp ---

bool waitpoint_at_present(Scheduler& scheduler, Task& task, Operation operation, Object* object);
Fiber& exchange_with_least(Scheduler& scheduler, Task& task);

// --- windows.cpp ---

void stay_on_thread(Scheduler& scheduler);
/// The main fiber, to leave the run with `state`.
Fiber& end_window(Scheduler& scheduler, RunState state);
/// The window ends before the event of `task`, which is the least.
Fiber& wait_for_window(Scheduler& scheduler, Task& task);
/// Leaves the run with `state`, if a task is running.
void leave_run(Scheduler& scheduler, RunState state);

// --- unwinding.cpp, visit.cpp, tasks.cpp, watching.cpp ---

/// Refuses a call of the running task after the end of the run: false.
bool refuse();
/// Called by a resumed task while an interruption is pending: serves visits until its turn has come. False if the run
/// is over.
bool answer_interrupt(Scheduler& scheduler);
/// Frees the stack of a task that has ended and been left.
void reclaim_ended(Scheduler& scheduler);
/// Shows an event of the running task.
void show(const Scheduler& scheduler, Operation operation, const Object* object);

// --- inline steps ---

// From this number of ready tasks on, their memory may be out of the cache.
inline constexpr std::uint32_t crowd_min = 32;

inline Task& task_of(EventNode& node) { return reinterpret_cast<Task&>(node); }  // the node is its first member

inline bool needs_attention(const Task& task) { return __builtin_expect(task.attention != 0, 0); }

inline std::uint64_t child_id(std::uint64_t parent, std::uint32_t number) {
  return Digest::mix(parent + (std::uint64_t{number} + 1) * 0x9E3779B97F4A7C15u);
}

inline void hash_events_of(Robot& robot) {
  if (turn.digest != robot.digest_in_use) turn.digest = robot.digest_in_use;
}

// A new instant resets the task's count of waitpoints.
inline void set_local_time(Task& task, Time time) {
  if (__builtin_expect(task.local_time == time, 1)) return;
  task.local_time = time;
  task.waitpoints = 0;
}

inline void put(Scheduler& scheduler, EventNode& node, const EventKey& key) {
  scheduler.agenda.events.insert(node, key);
  if (key.time <= scheduler.agenda.now) scheduler.fast_path.note_present_event(phase_of(key.order));
}

[[gnu::always_inline]] inline void execute(const Scheduler& scheduler, Task& task, Operation operation,
                                           const Object* object) {
  count_event(task, operation, object, scheduler.agenda.now);
  if (__builtin_expect(scheduler.watching.is_on, 0)) show(scheduler, operation, object);
}

// The only switch that is not in the caller's frame. `to` was found by functions that have returned, so that a parked
// stack occupies few cache lines.
inline void switch_fibers(Scheduler& scheduler, Fiber& from, Fiber& to) {
  if (&from == &to) return;
  ++scheduler.switches;
  if (__builtin_expect(can_switch_in_parts(from, to), 1)) {
    switch_fiber(from, to);
  } else {
    instance_for(to, running) = running;
    instance_for(to, turn) = turn;
    switch_fiber_and_storage(from, to);
  }
  if (scheduler.ended != nullptr) reclaim_ended(scheduler);
}

// True if the caller must depart to `to` from its own frame; false if the switch is done.
[[gnu::always_inline]] inline bool departs(Scheduler& scheduler, Fiber& from, Fiber& to) {
  if (__builtin_expect(&to == &from || !can_switch_in_parts(from, to) || sanitizer::present, 0)) {
    switch_fibers(scheduler, from, to);
    return false;
  }
  ++scheduler.switches;
  return true;
}

// From outside of tasks, until the run is left.
inline void enter_run(Scheduler& scheduler, Fiber& to) {
  bind_to_thread();
  turn.epoch = scheduler.epoch;
  switch_fibers(scheduler, scheduler.window.main, to);
}

// Makes `task` the running one; the caller must switch to the returned fiber at once.
inline Fiber& resume(Scheduler& scheduler, Task& task) {
  if (__builtin_expect(!StackArena::intact(task.fiber.stack), 0)) report_overflow(task);
  task.state = TaskState::running;
  running = &task;
  hash_events_of(*task.robot);
  if (scheduler.fast_path.passes_ties()) scheduler.fast_path.open(task, scheduler.agenda.now, scheduler.fast_epoch());
  return task.fiber;
}

// Resumes the task of the event taken out; if the event is a timeout, its wait ends.
inline Fiber& dispatch_task(Scheduler& scheduler, Task& task) {
  if (task.state == TaskState::blocked) {
    Object& object = *task.blocked_on;
    remove_waiter(task);
    task.wake = Wake::timed_out;
    set_local_time(task, scheduler.agenda.now);
    if (needs_attention(task)) take_back_priority(task, object);
  }
  return resume(scheduler, task);
}

// The event was just taken out: resumes its task and returns the fiber, or calls the action of a timer or message and
// returns null.
inline Fiber* dispatch_event(Scheduler& scheduler, EventNode& node) {
  Agenda& agenda = scheduler.agenda;
  agenda.now = agenda.events.present();
  if (__builtin_expect(node.fire != nullptr, 0)) {
    node.fire(node);
    return nullptr;
  }
  if (agenda.events.is_large()) fetch_coming(agenda.events);
  return &dispatch_task(scheduler, task_of(node));
}

}  // namespace waitpoint::kernel
