// SPDX-License-Identifier: BSD-3-Clause
//
// The waitpoint: how a task's events find their place in the order of virtual time, and are executed.
#include "fibers/kernel/access.hpp"
#include "fibers/kernel/debugger.hpp"
#include "fibers/kernel/local_clock.hpp"
#include "fibers/kernel/processor.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"
#include "fibers/switch/runtime_state.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::kernel {

// Goes on when the task's event is the least; false when the run is over.
[[gnu::always_inline]] inline bool Scheduler::arrive(Task& task) {
  if (__builtin_expect(agenda_.is_explored(), 0)) {
    task.state = TaskState::ready;
    agenda_.place(task, task.local_time);
    leave(task.fiber, next_fiber());
    return !interrupted_ || rest();
  }
  const EventEntry& least = agenda_.events.least();
  if (__builtin_expect(!agenda_.present.empty(), 0)) {
    if (!agenda_.precedes(task, agenda_.next_key())) {
      leave(task.fiber, give_way_to_present(task));
      return !interrupted_ || rest();
    }
  } else if (!agenda_.precedes(task, least.key)) {
    leave(task.fiber, give_way(task, least));
    return !interrupted_ || rest();
  }
  if (task.local_time >= agenda_.until) {
    leave(task.fiber, wait_for_window(task));
    if (interrupted_ && !rest()) return false;
  }
  agenda_.now = task.local_time;
  agenda_.events.advance(agenda_.now);
  if (free_pass_.may_stay(agenda_.now < least.key.time)) free_pass_.give(task, agenda_.now, unseen_in());
  return true;
}

bool Scheduler::arrive_after_signal(Task& task) { return arrive(task); }

// The waitpoint of a task whose segment has ended. Inline in all its callers: each frame of a parked task is a cache
// line that its next event waits for.
inline bool Scheduler::take_place(Task& task, Operation operation, Object* object) {
  task.operation = operation;
  task.at = object;
  if (object != nullptr) enter(*object);
  if (task.local_time != agenda_.now)
    task.turns = 1;
  else if (++task.turns > turns_max && !give_turn(task))
    return false;
  return arrive(task);
}

bool Scheduler::waitpoint_in_any_case(Operation operation, Object* object) {
  Task& task = *running;
  if (!free_pass_.holds_for(task)) return waitpoint_in_the_list(task, operation, object);
  ++task.turns;
  task.operation = operation;
  task.at = object;
  if (object != nullptr) enter(*object);
  execute(task, operation, object);
  if (free_pass_.holds_for(task)) free_pass_.give(task, agenda_.now, unseen_in());  // a watch may have ended it
  return true;
}

bool Scheduler::waitpoint_in_the_list(Task& task, Operation operation, Object* object) {
  if (unwinding_) return refuse();
  free_pass_.end();
  if (needs_attention(task)) {
    if ((task.attention & attention::timer) != 0) return act_for_timer(task, operation, object);
    if (!end_segment(task)) return false;
  }
  if (!take_place(task, operation, object)) return false;
  // Whoever comes back is running, and where it is stands in its record: it kept no registers for that.
  Task& next = *running;
  if (__builtin_expect(next.attention != 0 || watched_, 0)) return go_on_from_waitpoint(next);
  count_event(next, next.operation, next.at, agenda_.now);
  return true;
}

[[gnu::noinline]] bool Scheduler::go_on_from_waitpoint(Task& task) {
  if (ended_ != nullptr) reclaim_ended();
  if (interrupted_ && !rest()) return false;
  const Operation operation = task.operation;
  Object* const object = task.at;
  if (needs_attention(task) && !begin_segment(task, operation, object)) return false;
  execute(task, operation, object);
  return true;
}

bool Scheduler::look_at_clock_slowly(Task& task, Time& local) {
  const Time before = task.local_time;
  local = local_time(task);
  if ((task.attention & attention::timer) != 0) return true;
  free_pass_.end();
  if (local != before)
    task.turns = 0;
  else if (++task.turns > turns_max && !unwinding_ && give_turn(task))
    local = local_time(task);
  return unwinding_ ? refuse() : true;
}

bool Scheduler::yield() {
  if (unwinding_) return refuse();
  Task& task = *running;
  free_pass_.end();
  if (needs_attention(task)) {
    WAITPOINT_CHECK((task.attention & attention::timer) == 0, "a timer's callback waits");
    if (!end_segment(task)) return false;
    if (task.seat != nullptr) leave_processor(task);
  }
  task.operation = Operation::yield;
  task.at = nullptr;
  if (task.local_time != agenda_.now) task.turns = 0;
  check_progress(task);
  if (unwinding_) return false;
  agenda_.place(task, task.local_time);
  task.state = TaskState::ready;
  leave(task.fiber, next_fiber());
  if (interrupted_ && !rest()) return false;
  if (needs_attention(task) && !begin_segment(task, Operation::yield, nullptr)) return false;
  execute(task, Operation::yield, nullptr);
  return true;
}

// Whether the caller is to depart for `to`; else all is done.
[[gnu::always_inline]] inline bool Scheduler::departs(Fiber& from, Fiber& to) {
  if (__builtin_expect(&to == &from || !can_switch_in_parts(from, to) || sanitizer::present, 0)) {
    leave(from, to);
    return false;
  }
  ++switches_;
  return true;
}

// A task that only lets time pass, beside others that do, must be quick: what is rare is left to functions that are
// called last, since each register that is kept over a call is saved first.
Departure Scheduler::start_sleeping(Time time) {
  Task& task = *running;
  const bool is_plain = ordinary_ && task.attention == 0 && time > task.local_time && time < agenda_.until;
  if (__builtin_expect(!is_plain || !agenda_.present.empty() || watched_, 0)) return sleep_in_any_case(time);
  task.local_time = time;
  task.operation = Operation::sleep;
  task.at = nullptr;
  task.turns = 1;
  const EventEntry& least = agenda_.events.least();
  if (!agenda_.precedes(task, least.key)) return leave_sleeping(task, least);
  agenda_.now = time;
  agenda_.events.advance(time);
  free_pass_.give(task, time, epoch_);
  count_event(task, Operation::sleep, nullptr, time);
  return stay(Wake::woken);
}

[[gnu::noinline]] Departure Scheduler::leave_sleeping(Task& task, const EventEntry& least) {
  free_pass_.end();
  Fiber& to = give_way(task, least);
  if (departs(task.fiber, to)) return start_switch(task.fiber, to);
  return stay(go_on_from_waitpoint(*running) ? Wake::woken : Wake::unwinding);
}

[[gnu::noinline]] Departure Scheduler::sleep_in_any_case(Time time) {
  return stay(sleep_slowly(time) ? Wake::woken : Wake::unwinding);
}

bool Scheduler::sleep_slowly(Time time) {
  if (unwinding_) return refuse();
  Task& task = *running;
  free_pass_.end();
  if (needs_attention(task)) {
    WAITPOINT_CHECK((task.attention & attention::timer) == 0, "a timer's callback waits");
    if (!end_segment(task)) return false;
    if (task.seat != nullptr && time > task.local_time) leave_processor(task);
  }
  if (time > task.local_time) task.local_time = time;
  return take_place(task, Operation::sleep, nullptr) && go_on_from_waitpoint(*running);
}

// Whatever a timer does, it does in its turn: its event is the one now executing.
bool Scheduler::act_for_timer(Task& task, Operation operation, Object* object) {
  task.operation = operation;
  task.at = object;
  if (object != nullptr) enter(*object);
  hash_events_of(*task.robot);
  execute(task, operation, object);
  return true;
}

void Scheduler::set_watch(Watch* watch) {
  free_pass_.end();  // or who runs would pass its waitpoints unseen
  watch_ = watch;
  watched_ = watch != nullptr || sanitizer::present || debugger_view.watching;
}

void Scheduler::show(Operation operation, const Object* object) {
  // Every use of an object comes after all earlier ones; not so of memory.
  if (object != nullptr && object->kind != memory_kind && sanitizer::present) sanitizer::use(object);
  if (watch_ != nullptr) watch_->event(*watch_, {agenda_.now, running, operation, object});
  if (debugger_view.watching) show_debugger(agenda_.now, *running, operation, object);
}

void Scheduler::begin(Task& task) {
  if (needs_attention(task) && !begin_segment(task, Operation::start, nullptr)) return;
  execute(task, Operation::start, nullptr);
}

// A task that passes many waitpoints at one instant gives its ties a turn; false when the run is over.
bool Scheduler::give_turn(Task& task) {
  task.turns = 1;
  const Operation operation = task.operation;
  Object* const at = task.at;
  if (!yield()) return false;
  task.operation = operation;
  task.at = at;
  return true;
}

// If all tasks of an instant do nothing but give each other turns, the run is stuck.
void Scheduler::check_progress(Task& task) {
  if (turns_given_at_ != agenda_.now) {
    turns_given_at_ = agenda_.now;
    turns_given_ = 0;
  }
  if (++turns_given_ <= idle_turns_max + std::uint64_t{turns_max} * tasks_) return;
  culprit_ = &task;
  stop(StopCause::no_progress);
}

void Scheduler::record_output(std::uint64_t name, std::uint64_t value) {
  if (unwinding_) return;
  ++outputs_;
  turn.lane->add(name, value);
}

Departure Scheduler::start_blocking(Object& object) {
  Task& task = *running;
  // Who waits for one that can go on closes no cycle.
  if (__builtin_expect(object.holder_count != 0, 0) ||
      (object.owner != nullptr && __builtin_expect(object.owner->state != TaskState::ready, 0)) ||
      __builtin_expect(!can_hand_over(task), 0))
    return block_in_any_case(object, Time::max());
  append_waiter(object, task);
  task.state = TaskState::blocked;
  task.finite_wait = false;
  return hand_over(task);
}

Departure Scheduler::start_blocking_until(Object& object, Time deadline) {
  Task& task = *running;
  const EventKey key{deadline, make_order(task.phase, agenda_.chooser.tie_of_next())};
  if (__builtin_expect(
          !can_hand_over(task) || deadline <= agenda_.now || !agenda_.events.insert_at_once(task.event, key), 0))
    return block_in_any_case(object, deadline);
  append_waiter(object, task);
  task.state = TaskState::blocked;
  task.finite_wait = true;
  return hand_over(task);
}

[[gnu::noinline]] Departure Scheduler::block_in_any_case(Object& object, Time deadline) {
  if (unwinding_) {
    refuse();
    return stay(Wake::unwinding);
  }
  Task& task = *running;
  WAITPOINT_CHECK((task.attention & attention::timer) == 0, "a timer's callback waits");
  Fiber& to = park(task, object, deadline);
  if (departs(task.fiber, to)) return start_switch(task.fiber, to);
  return stay(go_on(*running, object));
}

[[gnu::noinline]] Wake Scheduler::go_on(Task& task, Object& object) {
  if (ended_ != nullptr) reclaim_ended();
  if (interrupted_ && !rest()) return Wake::unwinding;
  const Wake wake = task.wake;  // it may wait for its processor too, before it goes on
  const Operation operation = wake == Wake::woken ? Operation::resume : Operation::timeout;
  if (needs_attention(task) && !begin_segment(task, operation, &object)) return Wake::unwinding;
  execute(task, operation, &object);
  return wake;
}

bool Scheduler::suspend(Object& object) {
  if (unwinding_) return false;
  Task& task = *running;
  free_pass_.end();
  append_waiter(object, task);
  task.state = TaskState::blocked;
  task.finite_wait = false;
  leave(task.fiber, next_fiber());
  return !interrupted_ || rest();
}

}  // namespace waitpoint::kernel
