// SPDX-License-Identifier: BSD-3-Clause
// Steps that the scheduler's files take inline: for them alone.
#pragma once

#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/fetch_ahead.hpp"
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
  if (turn.lane != robot.lane) turn.lane = lane_ = robot.lane;
}

// A new instant for the task: it may pass as many waitpoints again.
inline void Scheduler::set_local_time(Task& task, Time time) {
  if (__builtin_expect(task.local_time == time, 1)) return;
  task.local_time = time;
  task.turns = 0;
}

inline void Scheduler::put(EventNode& node, const EventKey& key) {
  agenda_.events.insert(node, key);
  if (key.time <= agenda_.now) free_pass_.note_present_event(phase_of(key.order));
}

// The one place where fibers are switched. What is decided before is decided in functions that have returned: a parked
// stack is to keep few cache lines.
inline void Scheduler::leave(Fiber& from, Fiber& to) {
  if (&from == &to) return;
  ++switches_;
  switch_fiber(from, to);
  if (ended_ != nullptr) reclaim_ended();
}

inline void Scheduler::enter_run(Fiber& to) {
  bind_to_thread();
  leave(main_, to);
}

inline void Scheduler::resume(Task& task) {
  if (__builtin_expect(!StackArena::intact(task.fiber.stack), 0)) report_overflow(task);
  task.state = TaskState::running;
  running = &task;
  hash_events_of(*task.robot);
  if (free_pass_.may_stay()) free_pass_.give(task, agenda_.now, unseen_in());
}

// The task's event is next: it runs.
inline Task& Scheduler::go(Task& task) {
  if (task.state == TaskState::blocked) {
    Object& object = *task.blocked_on;
    remove_waiter(task);
    task.wake = Wake::timed_out;
    set_local_time(task, agenda_.now);
    if (needs_attention(task)) stop_waiting(task, object);
  }
  resume(task);
  return task;
}

// The task, which stands among those that wait for `object`, does so until `deadline`. False if it waits for ever for
// tasks of which one waits for it, and that ends the run.
inline bool Scheduler::stay_until(Task& task, const Object& object, Time deadline) {
  task.state = TaskState::blocked;
  task.finite_wait = deadline != Time::max();
  if (task.finite_wait) {
    agenda_.place_timeout(task, deadline < agenda_.now ? agenda_.now : deadline);
  } else if ((object.owner != nullptr || object.holder_count != 0) && ends_in_cycle(task)) {
    cause_ = StopCause::deadlock;
    return false;
  }
  return true;
}

// Algorithm 2: who was woken takes the global time as its local one.
inline void Scheduler::make_ready(Task& task) {
  if (__builtin_expect(sanitizer::present, 0)) sanitizer::release(task.blocked_on);
  remove_waiter(task);
  // One whose wait has just run out stands among those that are ready, and stays there.
  const bool placed = __builtin_expect(ReadySet::contains(task), 0);
  if (task.finite_wait && !placed) agenda_.events.remove(task.event);
  task.wake = Wake::woken;
  task.state = TaskState::ready;
  set_local_time(task, agenda_.now);
  if (!placed) agenda_.place(task, agenda_.now);
  free_pass_.note_present_event(task.phase);
}

// --- in the ordinary case: first in, first out, and the run goes on ---

// Whether `task`, were it blocked, could be left for the first of the present instant without more ado. Who passes
// unseen needs no attention, and nobody watches.
inline bool Scheduler::can_hand_over(const Task& task) const {
  if (!ordinary_ || !turn.is_unseen() || agenda_.present.size() - 1 >= many_ready) return false;
  const Task& next = *agenda_.present.first();
  return __builtin_expect(!agenda_.events.is_due(agenda_.now), 1) &&
         __builtin_expect(can_switch_in_parts(task.fiber, next.fiber), 1) && StackArena::intact(next.fiber.stack);
}

// `task` is blocked and can_hand_over(). Its free pass, for the present instant, goes over to the next one.
[[gnu::always_inline]] inline Departure Scheduler::hand_over(Task& task) {
  Task& next = agenda_.present.take();
  next.state = TaskState::running;
  running = &next;
  hash_events_of(*next.robot);
  if (__builtin_expect(next.attention != 0, 0)) free_pass_.end();
  ++switches_;
  return start_switch(task.fiber, next.fiber);
}

}  // namespace waitpoint::kernel
