// SPDX-License-Identifier: BSD-3-Clause
//
// The paper's Algorithm 1, step by step, with the calls that open and close the fast path. fast_calls.cpp and
// fast_path.hpp are short cuts to the same events.
//
//   waitpoint(operation, object)   end the segment: its cost is in the local time
//                                  announce the operation and the object
//                                  await the turn: unless the task's event is the least, place it at the local time and
//                                    switch to the task of dispatch()
//                                  the global time is the local time; begin the next segment; execute the event
//   sleep_until(time)              the local time becomes `time`, then as a waitpoint
//   yield()                        a waitpoint whose event is behind all tasks of the instant
//   dispatch()                     take out the least event: the global time is its time; resume its task
#include "fibers/kernel/waitpoint_calls.hpp"

#include "core/error.hpp"
#include "fibers/kernel/local_clock.hpp"
#include "fibers/kernel/processor.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"

namespace waitpoint::kernel {

// The steps, which are defined in the order of the algorithm. False: the run is over.
static bool announce(Scheduler& scheduler, Task& task, Operation operation, Object* object);
static bool await_turn(Scheduler& scheduler, Task& task);
static bool end_segment(Scheduler& scheduler, Task& task);
static Fiber& dispatch_instead_of(Scheduler& scheduler, Task& task);
static bool yield_after(Scheduler& scheduler, std::uint32_t waitpoints);
static bool yield_to_ties(Scheduler& scheduler, Task& task);
static void check_progress(Scheduler& scheduler, Task& task, std::uint32_t waitpoints);
static bool timer_waitpoint(Scheduler& scheduler, Task& task, Operation operation, Object* object);

// --- the waitpoint ---

bool waitpoint_slow(Scheduler& scheduler, Operation operation, Object* object) {
  Task& task = *running;
  if (turn.holds_for(task)) return waitpoint_at_present(scheduler, task, operation, object);
  if (scheduler.interruption.is_unwinding) return refuse();
  turn.close();
  if (needs_attention(task)) {
    if ((task.attention & attention::timer) != 0) return timer_waitpoint(scheduler, task, operation, object);
    if (!end_segment(scheduler, task)) return false;
  }
  if (!announce(scheduler, task, operation, object) || !await_turn(scheduler, task)) return false;
  // Read again from the running task's record, so that no register is kept over the switch.
  Task& next = *running;
  if (__builtin_expect(next.attention != 0 || scheduler.watching.is_on, 0)) return end_waitpoint(scheduler, next);
  count_event(next, next.operation, next.at, scheduler.agenda.now);
  return true;
}

// Writes the next operation to the task's record; its segment has ended. False if the run is over. Inline in its
// callers, as is await_turn(): each frame of a parked task is a cache line that its next event misses.
inline bool announce(Scheduler& scheduler, Task& task, Operation operation, Object* object) {
  task.operation = operation;
  task.at = object;
  if (object != nullptr) enter(*object);
  if (task.local_time != scheduler.agenda.now)
    task.waitpoints = 1;
  else if (++task.waitpoints > waitpoints_max)
    return yield_to_ties(scheduler, task);
  return true;
}

// The task's event is at its local time; returns when it is the least. False if the run is over.
[[gnu::always_inline]] inline bool await_turn(Scheduler& scheduler, Task& task) {
  if (!scheduler.agenda.is_next(task)) {
    switch_fibers(scheduler, task.fiber, dispatch_instead_of(scheduler, task));
    return !scheduler.interruption.is_pending || answer_interrupt(scheduler);
  }
  if (task.local_time >= scheduler.agenda.until) {
    switch_fibers(scheduler, task.fiber, wait_for_window(scheduler, task));
    if (scheduler.interruption.is_pending && !answer_interrupt(scheduler)) return false;
  }
  scheduler.agenda.advance(task.local_time);
  if (scheduler.fast_path.passes_ties(scheduler.agenda.now < scheduler.agenda.events.least().key.time))
    scheduler.fast_path.open(task, scheduler.agenda.now, scheduler.fast_epoch());
  return true;
}

// The task's event is the one now executing: begins the next segment and executes the event. False if the run is over.
[[gnu::noinline]] bool end_waitpoint(Scheduler& scheduler, Task& task) {
  if (scheduler.ended != nullptr) reclaim_ended(scheduler);
  if (scheduler.interruption.is_pending && !answer_interrupt(scheduler)) return false;
  const Operation operation = task.operation;
  Object* const object = task.at;
  if (needs_attention(task) && !begin_segment(scheduler, task, operation, object)) return false;
  execute(scheduler, task, operation, object);
  return true;
}

// --- segments: the computation between two waitpoints, see local_clock.hpp ---

// False if the run is over: it may end while the task awaits its shared processor or its duration is recorded.
bool end_segment(Scheduler& scheduler, Task& task) {
  if (task.clock != nullptr && task.clock->end != nullptr) task.clock->end(*task.clock, task);
  return !scheduler.interruption.is_unwinding;
}

// The task continues with `operation`, after the handlers of its pending signals: these take time, so the task awaits
// its turn again after each. False if the run is over.
[[gnu::noinline]] bool begin_segment(Scheduler& scheduler, Task& task, Operation operation, Object* object) {
  if (task.seat != nullptr && !take_processor(task)) return false;
  while ((task.attention & attention::signal) != 0) {
    const EventFootprint footprint = task.footprint;
    task.attention = static_cast<std::uint8_t>(task.attention & ~attention::signal);
    if (task.clock != nullptr && task.clock->begin != nullptr) task.clock->begin(*task.clock, task);
    WAITPOINT_CHECK(scheduler.hooks.deliver_signals != nullptr, "a signal is pending without a hook that delivers it");
    scheduler.hooks.deliver_signals(task);
    if (scheduler.interruption.is_unwinding || !end_segment(scheduler, task)) return false;
    task.operation = operation;
    task.at = object;
    task.footprint = footprint;
    if (!await_turn(scheduler, task)) return false;
  }
  if (task.clock != nullptr && task.clock->begin != nullptr) task.clock->begin(*task.clock, task);
  return true;
}

// --- the least event ---

static bool can_exchange(const Scheduler& scheduler) {
  return scheduler.agenda.present.empty() && scheduler.fast_path.is_enabled() && !scheduler.agenda.is_explored();
}

// Places the task's event and takes the least one out.
inline Fiber& dispatch_instead_of(Scheduler& scheduler, Task& task) {
  task.state = TaskState::ready;
  if (can_exchange(scheduler)) return exchange_with_least(scheduler, task);
  scheduler.agenda.place(task, task.local_time);
  return dispatch(scheduler);
}

// Takes out events in order: calls the actions of timers and messages, and resumes the task of the first other event.
// Returns its fiber, which the caller must switch to; at the end of the window or of the run, the main fiber.
Fiber& dispatch(Scheduler& scheduler) {
  Agenda& agenda = scheduler.agenda;
  if (__builtin_expect(agenda.is_explored(), 0)) return dispatch_explored(scheduler);
  for (;;) {
    if (agenda.is_present_next()) {
      Task& task = agenda.present.take();
      if (agenda.present.size() >= crowd_min) fetch_coming(agenda.present);
      return resume(scheduler, task);
    }
    EventNode* node = agenda.events.pop_before(agenda.until);
    if (node == nullptr) return end_window(scheduler, agenda.size() == 0 ? RunState::idle : RunState::reached);
    if (Fiber* fiber = dispatch_event(scheduler, *node)) return *fiber;
  }
}

// --- sleeping and yielding ---

[[gnu::noinline]] Departure sleep_slow(Scheduler& scheduler, Time time) {
  if (scheduler.interruption.is_unwinding) {
    refuse();
    return stay(Wake::unwinding);
  }
  Task& task = *running;
  turn.close();
  if (needs_attention(task)) {
    WAITPOINT_REQUIRE((task.attention & attention::timer) == 0, "a timer's callback waits");
    if (!end_segment(scheduler, task)) return stay(Wake::unwinding);
    if (task.seat != nullptr && time > task.local_time) leave_processor(task);
  }
  if (time > task.local_time) task.local_time = time;
  const bool goes_on = announce(scheduler, task, Operation::sleep, nullptr) && await_turn(scheduler, task) &&
                       end_waitpoint(scheduler, *running);
  return stay(goes_on ? Wake::woken : Wake::unwinding);
}

bool yield(Scheduler& scheduler) { return yield_after(scheduler, 1); }

// A yield of the running task, which has passed so many waitpoints since its last one.
bool yield_after(Scheduler& scheduler, std::uint32_t waitpoints) {
  if (scheduler.interruption.is_unwinding) return refuse();
  Task& task = *running;
  turn.close();
  if (needs_attention(task)) {
    WAITPOINT_REQUIRE((task.attention & attention::timer) == 0, "a timer's callback waits");
    if (!end_segment(scheduler, task)) return false;
    if (task.seat != nullptr) leave_processor(task);
  }
  task.operation = Operation::yield;
  task.at = nullptr;
  if (task.local_time != scheduler.agenda.now) task.waitpoints = 0;
  check_progress(scheduler, task, waitpoints);
  if (scheduler.interruption.is_unwinding) return false;
  scheduler.agenda.place(task, task.local_time);
  task.state = TaskState::ready;
  switch_fibers(scheduler, task.fiber, dispatch(scheduler));
  return end_waitpoint(scheduler, *running);
}

// Yields to the task's ties, after waitpoints_max waitpoints at one instant. False if the run is over.
bool yield_to_ties(Scheduler& scheduler, Task& task) {
  task.waitpoints = 1;
  const Operation operation = task.operation;
  Object* const at = task.at;
  if (!yield_after(scheduler, waitpoints_max)) return false;
  task.operation = operation;
  task.at = at;
  return true;
}

// Stops the run if all tasks of an instant only yield to each other, or exchange something without end.
void check_progress(Scheduler& scheduler, Task& task, std::uint32_t waitpoints) {
  RunProgress& progress = scheduler.progress;
  progress.count_yield(scheduler.agenda.now, waitpoints, turn.transferred);
  turn.transferred = false;
  if (progress.ends_turn_of_robot()) scheduler.roster.put_last(*task.robot);
  if (!progress.stands_still(scheduler.roster.tasks())) return;
  scheduler.window.culprit = &task;
  stop(scheduler, StopCause::no_progress);
}

// --- events without a waitpoint ---

bool read_clock_slow(Scheduler& scheduler, Time& local) {
  Task& task = *running;
  const Time before = task.local_time;
  local = local_time(task);
  if ((task.attention & attention::timer) != 0) return true;
  turn.close();
  if (local != before)
    task.waitpoints = 0;
  else if (++task.waitpoints > waitpoints_max && !scheduler.interruption.is_unwinding && yield_to_ties(scheduler, task))
    local = local_time(task);
  return scheduler.interruption.is_unwinding ? refuse() : true;
}

// A timer's callback uses a primitive: it has its turn already, since its event is the one now executing.
bool timer_waitpoint(Scheduler& scheduler, Task& task, Operation operation, Object* object) {
  task.operation = operation;
  task.at = object;
  if (object != nullptr) enter(*object);
  hash_events_of(*task.robot);
  execute(scheduler, task, operation, object);
  return true;
}

void record_output(std::uint64_t name, std::uint64_t value) {
  if (running->scheduler->interruption.is_unwinding) return;
  ++running->robot->outputs;
  turn.digest->add(name, value);
}

}  // namespace waitpoint::kernel
