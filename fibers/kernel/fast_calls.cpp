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

// The rare cases.
static Departure depart_sleeping(Scheduler& scheduler, Task& task);
static Departure block_with_far_timeout(Scheduler& scheduler, Object& object, EventKey timeout);
static Task* wake_from_far_timeout(Scheduler& scheduler, Object& object);

// --- waitpoints ---

// The fast path holds for the task, but each event is shown to a watch: executes it without a search of the list.
bool waitpoint_at_present(Scheduler& scheduler, Task& task, Operation operation, Object* object) {
  ++task.waitpoints;
  task.operation = operation;
  task.at = object;
  if (object != nullptr) enter(*object);
  execute(scheduler, task, operation, object);
  if (turn.holds_for(task))
    scheduler.fast_path.open(task, scheduler.agenda.now, scheduler.fast_epoch());  // a watch may have closed it
  return true;
}

// The list's least event precedes the task's, and the present queue is empty: inserts one and takes the other in one
// step.
Fiber& exchange_with_least(Scheduler& scheduler, Task& task) {
  Agenda& agenda = scheduler.agenda;
  const EventEntry& least = agenda.events.least();
  const EventKey own = agenda.key(task, task.local_time);
  if (least.key.time >= agenda.until) {
    agenda.events.insert(task.event, own);
    return end_window(scheduler, RunState::reached);
  }
  Fiber* const next = dispatch_event(scheduler, agenda.events.exchange(least, task.event, own));
  return next != nullptr ? *next : dispatch(scheduler);
}

// --- sleeping ---

Departure start_sleep(Scheduler& scheduler, Time time) {
  Task& task = *running;
  const bool is_plain = scheduler.fast_path.takes_short_cuts() && task.attention == 0 && time > task.local_time &&
                        time < scheduler.agenda.until;
  if (__builtin_expect(!is_plain || !scheduler.agenda.present.empty() || scheduler.watching.is_on, 0))
    return sleep_slow(scheduler, time);
  task.local_time = time;
  task.operation = Operation::sleep;
  task.at = nullptr;
  task.waitpoints = 1;
  if (!scheduler.agenda.precedes(task, scheduler.agenda.events.least().key)) return depart_sleeping(scheduler, task);
  scheduler.agenda.advance(time);
  scheduler.fast_path.open(task, time, scheduler.epoch);
  count_event(task, Operation::sleep, nullptr, time);
  return stay(Wake::woken);
}

[[gnu::noinline]] Departure depart_sleeping(Scheduler& scheduler, Task& task) {
  turn.close();
  task.state = TaskState::ready;
  Fiber& to = exchange_with_least(scheduler, task);
  if (departs(scheduler, task.fiber, to)) return start_switch(task.fiber, to);
  return stay(end_waitpoint(scheduler, *running) ? Wake::woken : Wake::unwinding);
}

// --- blocking and waking ---

// True if the running task, once blocked, can be left for the first task of the present queue at once: that event is
// the least, events are not watched, and the switch needs no other work.
inline bool can_dispatch_present(const Scheduler& scheduler) {
  const Agenda& agenda = scheduler.agenda;
  if (!scheduler.fast_path.takes_short_cuts() || !turn.is_fast() || agenda.present.size() - 1 >= crowd_min)
    return false;
  const Task& next = *agenda.present.first();
  return __builtin_expect(!agenda.events.is_due(agenda.now), 1) &&
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
[[gnu::always_inline]] inline Departure leave_for_present(Scheduler& scheduler, Task& task, Object& object,
                                                          bool has_timeout) {
  append_waiter(object, task);
  task.state = TaskState::blocked;
  task.finite_wait = has_timeout;
  Task& next = scheduler.agenda.present.take();
  next.state = TaskState::running;
  running = &next;
  hash_events_of(*next.robot);
  if (__builtin_expect(next.attention != 0, 0)) turn.close();
  ++scheduler.switches;
  return start_switch(task.fiber, next.fiber);
}

template <bool is_finite>
Departure start_block(Scheduler& scheduler, Object& object, Time deadline) {
  Task& task = *running;
  if (__builtin_expect(!can_dispatch_present(scheduler), 0)) return block_slow(scheduler, object, deadline);
  if constexpr (is_finite) {
    if (__builtin_expect(deadline <= scheduler.agenda.now, 0)) return block_slow(scheduler, object, deadline);
    const EventKey key{deadline, make_order(task.phase, scheduler.agenda.chooser.tie_of_next(task))};
    if (__builtin_expect(!scheduler.agenda.events.try_insert_fast(task.event, key), 0))
      return block_with_far_timeout(scheduler, object, key);
  } else if (!cannot_close_cycle(object)) {
    return block_slow(scheduler, object, deadline);
  }
  return leave_for_present(scheduler, task, object, is_finite);
}

// The timeout's place is not near the end of the run: with many tasks the usual case.
[[gnu::noinline]] Departure block_with_far_timeout(Scheduler& scheduler, Object& object, EventKey timeout) {
  scheduler.agenda.events.insert(running->event, timeout);
  return leave_for_present(scheduler, *running, object, true);
}
template Departure start_block<true>(Scheduler&, Object&, Time);
template Departure start_block<false>(Scheduler&, Object&, Time);

[[gnu::always_inline]] inline Task* wake_here(Scheduler& scheduler, Object& object) {
  Task& first = remove_first_waiter(object);
  first.wake = Wake::woken;
  first.state = TaskState::ready;
  set_local_time(first, scheduler.agenda.now);
  scheduler.agenda.place_present(first);
  return &first;
}

// wake() of the first waiter, in the common case.
Task* wake_waiter(Scheduler& scheduler, Object& object) {
  Task& first = *object.first_waiter;
  const bool is_usual = __builtin_expect(scheduler.fast_path.takes_short_cuts(), 1) &&
                        object.epoch == scheduler.epoch && first.phase == Phase::tasks;
  if (__builtin_expect(!is_usual, 0)) return wake_one_slow(scheduler, object);
  if (first.finite_wait && __builtin_expect(!scheduler.agenda.events.try_remove_fast(first.event), 0))
    return wake_from_far_timeout(scheduler, object);
  return wake_here(scheduler, object);
}

[[gnu::noinline]] Task* wake_from_far_timeout(Scheduler& scheduler, Object& object) {
  scheduler.agenda.events.remove(object.first_waiter->event);
  return wake_here(scheduler, object);
}

}  // namespace waitpoint::kernel
