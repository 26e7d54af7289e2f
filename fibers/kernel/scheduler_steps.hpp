// SPDX-License-Identifier: BSD-3-Clause
// Inline steps shared by the scheduler's source files; included by them only.
#pragma once

#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/fetch_ahead.hpp"
#include "fibers/kernel/processor.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/waiters.hpp"
#include "fibers/switch/fiber.hpp"
#include "fibers/switch/runtime_state.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::kernel {

inline bool needs_attention(const Task& task) { return __builtin_expect(task.attention != 0, 0); }

inline std::uint64_t child_id(std::uint64_t parent, std::uint32_t number) {
  return Digest::mix(parent + (std::uint64_t{number} + 1) * 0x9E3779B97F4A7C15u);
}

inline void Scheduler::hash_events_of(Robot& robot) {
  if (turn.digest != robot.digest_in_use) turn.digest = digest_in_use_ = robot.digest_in_use;
}

// A new instant resets the task's count of waitpoints.
inline void Scheduler::set_local_time(Task& task, Time time) {
  if (__builtin_expect(task.local_time == time, 1)) return;
  task.local_time = time;
  task.waitpoints = 0;
}

inline void Scheduler::put(EventNode& node, const EventKey& key) {
  agenda_.events.insert(node, key);
  if (key.time <= agenda_.now) fast_path_.note_present_event(phase_of(key.order));
}

// The only switch that is not in the caller's frame. `to` was found by functions that have returned, so that a parked
// stack occupies few cache lines.
inline void Scheduler::switch_fibers(Fiber& from, Fiber& to) {
  if (&from == &to) return;
  ++switches_;
  if (__builtin_expect(can_switch_in_parts(from, to), 1)) {
    switch_fiber(from, to);
  } else {
    instance_for(to, running) = running;
    instance_for(to, turn) = turn;
    switch_fiber_and_storage(from, to);
  }
  if (ended_ != nullptr) reclaim_ended();
}

// True if the caller must depart to `to` from its own frame; false if the switch is done.
[[gnu::always_inline]] inline bool Scheduler::departs(Fiber& from, Fiber& to) {
  if (__builtin_expect(&to == &from || !can_switch_in_parts(from, to) || sanitizer::present, 0)) {
    switch_fibers(from, to);
    return false;
  }
  ++switches_;
  return true;
}

inline void Scheduler::enter_run(Fiber& to) {
  bind_to_thread();
  switch_fibers(main_, to);
}

// Makes `task` the running one; the caller must switch to the returned fiber at once.
inline Fiber& Scheduler::resume(Task& task) {
  if (__builtin_expect(!StackArena::intact(task.fiber.stack), 0)) report_overflow(task);
  task.state = TaskState::running;
  running = &task;
  hash_events_of(*task.robot);
  if (fast_path_.passes_ties()) fast_path_.open(task, agenda_.now, fast_epoch());
  return task.fiber;
}

// Resumes the task of the event taken out; if the event is a timeout, its wait ends.
inline Fiber& Scheduler::dispatch_task(Task& task) {
  if (task.state == TaskState::blocked) {
    Object& object = *task.blocked_on;
    remove_waiter(task);
    task.wake = Wake::timed_out;
    set_local_time(task, agenda_.now);
    if (needs_attention(task)) take_back_priority(task, object);
  }
  return resume(task);
}

// The event was just taken out: resumes its task and returns the fiber, or calls the action of a timer or message and
// returns null.
inline Fiber* Scheduler::dispatch_event(EventNode& node) {
  agenda_.now = agenda_.events.present();
  if (__builtin_expect(node.fire != nullptr, 0)) {
    node.fire(node);
    return nullptr;
  }
  if (agenda_.events.is_large()) fetch_coming(agenda_.events);
  return &dispatch_task(task_of(node));
}

}  // namespace waitpoint::kernel
