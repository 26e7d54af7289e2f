// SPDX-License-Identifier: BSD-3-Clause
// Steps that the scheduler's files take inline: for them alone.
#pragma once

#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/sanitizer.hpp"
#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::kernel {

inline bool needs_attention(const Task& task) { return __builtin_expect(task.attention != 0, 0); }

inline std::uint64_t child_id(std::uint64_t parent, std::uint32_t number) {
  return Digest::mix(parent + (std::uint64_t{number} + 1) * 0x9E3779B97F4A7C15u);
}

inline void Scheduler::hash_events_of(Robot& robot) { lane_ = robot.lane; }

// The running task may pass its waitpoints at the present instant without a look at the event list, until something
// comes between.
inline void Scheduler::let_pass(const Task& task) { free_at_ = task.attention == 0 ? now_ : never; }

inline void Scheduler::end_free_passes() { free_at_ = never; }

// An event of this phase was put in for the present instant.
inline void Scheduler::note_present_event(Phase phase) {
  if (running != nullptr && (!may_stay_ || phase < running->phase)) end_free_passes();
}

// A new instant for the task: it may pass as many waitpoints again.
inline void Scheduler::set_local_time(Task& task, Time time) {
  if (task.local_time == time) return;
  task.local_time = time;
  task.turns = 0;
}

inline void Scheduler::put(EventNode& node, const EventKey& key) {
  events_.insert(node, key);
  if (key.time <= now_) note_present_event(phase_of(key.order));
}

// The task's event at `time`.
inline void Scheduler::place(Task& task, Time time) {
  if (time <= now_) {
    if (chooser_.order() == Order::fifo && PresentQueue::is_for(task.phase))
      return present_.add(task, key(task, time).order);
    if (is_explored() && task.phase == Phase::tasks) return ready_.add(task);
  }
  events_.insert(task.event, key(task, time));
}

// The same, of a task that waits until then at the longest, and may be taken out again.
inline void Scheduler::place_timeout(Task& task, Time time) {
  if (__builtin_expect(is_explored(), 0)) return place(task, time);
  events_.insert(task.event, key(task, time));
}

// Of the least event.
inline EventKey Scheduler::next_key() const {
  const EventKey& least = events_.least().key;
  if (present_.empty()) return least;
  const EventKey first{now_, present_.order()};
  return first < least ? first : least;
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

// Whether the task's event, were it in the list, would come before `other`.
inline bool Scheduler::precedes(const Task& task, const EventKey& other) {
  if (task.local_time != other.time) return task.local_time < other.time;
  // First-in-first-out: at the present instant a task goes on although others tie with it. One whose time has moved on
  // comes behind them, as through the list: else it would depend on unrelated events in between.
  const std::uint64_t tie = chooser_.order() == Order::seeded ? chooser_.tie(task)
                            : task.local_time == now_         ? 0
                                                              : tie_mask;
  return make_order(task.phase, tie) <= other.order;
}

inline void Scheduler::append_waiter(Object& object, Task& task) {
  task.blocked_on = &object;
  task.next_waiter = nullptr;
  task.previous_waiter = object.last_waiter;
  (object.last_waiter == nullptr ? object.first_waiter : object.last_waiter->next_waiter) = &task;
  object.last_waiter = &task;
}

inline Task& Scheduler::remove_first_waiter(Object& object) {
  Task& task = *object.first_waiter;
  object.first_waiter = task.next_waiter;
  (object.first_waiter == nullptr ? object.last_waiter : object.first_waiter->previous_waiter) = nullptr;
  task.blocked_on = nullptr;
  return task;
}

inline void Scheduler::remove_waiter(Task& task) {
  Object& object = *task.blocked_on;
  (task.previous_waiter == nullptr ? object.first_waiter : task.previous_waiter->next_waiter) = task.next_waiter;
  (task.next_waiter == nullptr ? object.last_waiter : task.next_waiter->previous_waiter) = task.previous_waiter;
  task.blocked_on = nullptr;
}

inline void Scheduler::resume(Task& task) {
  if (__builtin_expect(!StackArena::intact(task.fiber.stack), 0)) report_overflow(task);
  task.state = TaskState::running;
  running = &task;
  hash_events_of(*task.robot);
  if (may_stay_) let_pass(task);
}

// The task's event is next: it runs.
inline Task& Scheduler::go(Task& task) {
  if (task.state == TaskState::blocked) {
    Object& object = *task.blocked_on;
    remove_waiter(task);
    task.wake = Wake::timed_out;
    set_local_time(task, now_);
    if (needs_attention(task)) stop_waiting(task, object);
  }
  resume(task);
  return task;
}

// The task, which stands among those that wait for `object`, does so until `deadline`. False if it waits for ever for
// tasks of which one waits for it.
inline bool Scheduler::stay_until(Task& task, const Object& object, Time deadline) {
  task.state = TaskState::blocked;
  task.finite_wait = deadline != Time::max();
  if (task.finite_wait) {
    place_timeout(task, deadline < now_ ? now_ : deadline);
  } else if ((object.owner != nullptr || object.holder_count != 0) && closes_a_cycle(task)) {
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
  if (task.finite_wait && !placed) events_.remove(task.event);
  task.wake = Wake::woken;
  task.state = TaskState::ready;
  set_local_time(task, now_);
  if (!placed) place(task, now_);
  note_present_event(task.phase);
}

// --- in the ordinary case: first in, first out, and the run goes on ---

// As next_fiber(), mostly by one of the present instant.
inline Fiber& Scheduler::next_of_present() {
  if (present_.empty() || events_.is_due(now_)) return next_fiber();
  Task& task = present_.take();
  if (__builtin_expect(present_.size() >= many_ready, 0)) prepare_ready();
  resume(task);
  return task.fiber;
}

// As make_ready() of the first that waits for `object`; there must be one.
inline Task& Scheduler::make_first_ready(Object& object) {
  Task& task = remove_first_waiter(object);
  if (task.finite_wait) events_.remove(task.event);
  task.wake = Wake::woken;
  task.state = TaskState::ready;
  set_local_time(task, now_);
  present_.add(task, key(task, now_).order);
  note_present_event(task.phase);
  return task;
}

}  // namespace waitpoint::kernel
