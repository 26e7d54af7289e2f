// SPDX-License-Identifier: BSD-3-Clause
//
// Short cuts for the common cases of waitpoint.cpp and waiting.cpp in the first-in-first-out order. Each executes the
// same events as the plain path, or calls its ..._slow counterpart with nothing changed. A run without them
// (SimulationOptions::fast_paths) has the same digest.
//
// Rare cases are calls in tail position: each register kept over a call would be saved first.
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"

namespace waitpoint::kernel {

// For the coming window: short cuts are taken unless the run is interrupted.
void Scheduler::allow_fast_paths() { fast_allowed_ = fast_path_.passes_ties() && !interrupted_; }

void Scheduler::use_fast_paths(bool used) {
  WAITPOINT_CHECK(running == nullptr && first_task() == nullptr, "the fast paths are chosen while tasks run");
  fast_path_.enable(used);
  fast_path_.allow(agenda_.chooser.order());
}

// --- waitpoints ---

// The fast path holds for the task, but each event is shown to a watch: executes it without a search of the list.
bool Scheduler::waitpoint_at_present(Task& task, Operation operation, Object* object) {
  ++task.waitpoints;
  task.operation = operation;
  task.at = object;
  if (object != nullptr) enter(*object);
  execute(task, operation, object);
  if (fast_path_.holds_for(task)) fast_path_.open(task, agenda_.now, fast_epoch());  // a watch may have closed it
  return true;
}

// The list's least event precedes the task's, and the present queue is empty: inserts one and takes the other in one
// step.
Fiber& Scheduler::exchange_with_least(Task& task) {
  const EventEntry& least = agenda_.events.least();
  const EventKey own = agenda_.key(task, task.local_time);
  if (least.key.time >= agenda_.until) {
    agenda_.events.insert(task.event, own);
    return end_window(RunState::reached);
  }
  Fiber* const next = dispatch_event(agenda_.events.exchange(least, task.event, own));
  return next != nullptr ? *next : dispatch();
}

// --- sleeping ---

Departure Scheduler::start_sleep(Time time) {
  Task& task = *running;
  const bool is_plain = fast_allowed_ && task.attention == 0 && time > task.local_time && time < agenda_.until;
  if (__builtin_expect(!is_plain || !agenda_.present.empty() || watched_, 0)) return sleep_slow(time);
  task.local_time = time;
  task.operation = Operation::sleep;
  task.at = nullptr;
  task.waitpoints = 1;
  if (!agenda_.precedes(task, agenda_.events.least().key)) return depart_sleeping(task);
  agenda_.advance(time);
  fast_path_.open(task, time, epoch_);
  count_event(task, Operation::sleep, nullptr, time);
  return stay(Wake::woken);
}

[[gnu::noinline]] Departure Scheduler::depart_sleeping(Task& task) {
  fast_path_.close();
  task.state = TaskState::ready;
  Fiber& to = exchange_with_least(task);
  if (departs(task.fiber, to)) return start_switch(task.fiber, to);
  return stay(end_waitpoint(*running) ? Wake::woken : Wake::unwinding);
}

// --- blocking and waking ---

// True if the running task, once blocked, can be left for the first task of the present queue at once: that event is
// the least, events are not watched, and the switch needs no other work.
inline bool Scheduler::can_dispatch_present() const {
  if (!fast_allowed_ || !turn.is_fast() || agenda_.present.size() - 1 >= crowd_min) return false;
  const Task& next = *agenda_.present.first();
  return __builtin_expect(!agenda_.events.is_due(agenda_.now), 1) &&
         __builtin_expect(can_switch_in_parts(running->fiber, next.fiber), 1) && StackArena::intact(next.fiber.stack);
}

// True if a wait for `object` without a timeout cannot close a cycle.
inline bool cannot_close_cycle(const Object& object) {
  return __builtin_expect(object.holder_count == 0, 1) &&
         // A wait for a ready owner closes no cycle.
         (object.owner == nullptr || __builtin_expect(object.owner->state == TaskState::ready, 1));
}

// The fast path, open for the present instant, passes from `task`, which blocks on `object`, to the next one. A timeout
// is in the list already.
[[gnu::always_inline]] inline Departure Scheduler::leave_for_present(Task& task, Object& object, bool has_timeout) {
  append_waiter(object, task);
  task.state = TaskState::blocked;
  task.finite_wait = has_timeout;
  Task& next = agenda_.present.take();
  next.state = TaskState::running;
  running = &next;
  hash_events_of(*next.robot);
  if (__builtin_expect(next.attention != 0, 0)) fast_path_.close();
  ++switches_;
  return start_switch(task.fiber, next.fiber);
}

template <bool is_finite>
Departure Scheduler::start_block(Object& object, Time deadline) {
  Task& task = *running;
  if (__builtin_expect(!can_dispatch_present(), 0)) return block_slow(object, deadline);
  if constexpr (is_finite) {
    if (__builtin_expect(deadline <= agenda_.now, 0)) return block_slow(object, deadline);
    const EventKey key{deadline, make_order(task.phase, agenda_.chooser.tie_of_next(task))};
    if (__builtin_expect(!agenda_.events.try_insert_fast(task.event, key), 0))
      return block_with_far_timeout(object, key);
  } else if (!cannot_close_cycle(object)) {
    return block_slow(object, deadline);
  }
  return leave_for_present(task, object, is_finite);
}

// The timeout's place is not near the end of the run: with many tasks the usual case.
[[gnu::noinline]] Departure Scheduler::block_with_far_timeout(Object& object, EventKey timeout) {
  agenda_.events.insert(running->event, timeout);
  return leave_for_present(*running, object, true);
}
template Departure Scheduler::start_block<true>(Object&, Time);
template Departure Scheduler::start_block<false>(Object&, Time);

[[gnu::always_inline]] inline Task* Scheduler::wake_here(Object& object) {
  Task& first = remove_first_waiter(object);
  first.wake = Wake::woken;
  first.state = TaskState::ready;
  set_local_time(first, agenda_.now);
  agenda_.place_present(first);
  return &first;
}

// wake() of the first waiter, in the common case.
Task* Scheduler::wake_waiter(Object& object) {
  Task& first = *object.first_waiter;
  const bool is_usual = __builtin_expect(fast_allowed_, 1) && object.epoch == epoch_ && first.phase == Phase::tasks;
  if (__builtin_expect(!is_usual, 0)) return wake_one_slow(object);
  if (first.finite_wait && __builtin_expect(!agenda_.events.try_remove_fast(first.event), 0))
    return wake_from_far_timeout(object);
  return wake_here(object);
}

[[gnu::noinline]] Task* Scheduler::wake_from_far_timeout(Object& object) {
  agenda_.events.remove(object.first_waiter->event);
  return wake_here(object);
}

}  // namespace waitpoint::kernel
