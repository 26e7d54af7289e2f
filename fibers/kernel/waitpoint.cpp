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
#include "fibers/kernel/access.hpp"
#include "fibers/kernel/debugger.hpp"
#include "fibers/kernel/local_clock.hpp"
#include "fibers/kernel/processor.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"

namespace waitpoint::kernel {

// --- the waitpoint ---

bool Scheduler::waitpoint_slow(Operation operation, Object* object) {
  Task& task = *running;
  if (fast_path_.holds_for(task)) return waitpoint_at_present(task, operation, object);
  if (unwinding_) return refuse();
  fast_path_.close();
  if (needs_attention(task)) {
    if ((task.attention & attention::timer) != 0) return timer_waitpoint(task, operation, object);
    if (!end_segment(task)) return false;
  }
  if (!announce(task, operation, object) || !await_turn(task)) return false;
  // Read again from the running task's record, so that no register is kept over the switch.
  Task& next = *running;
  if (__builtin_expect(next.attention != 0 || watched_, 0)) return end_waitpoint(next);
  count_event(next, next.operation, next.at, agenda_.now);
  return true;
}

// Writes the next operation to the task's record; its segment has ended. False if the run is over. Inline in its
// callers, as is await_turn(): each frame of a parked task is a cache line that its next event misses.
inline bool Scheduler::announce(Task& task, Operation operation, Object* object) {
  task.operation = operation;
  task.at = object;
  if (object != nullptr) enter(*object);
  if (task.local_time != agenda_.now)
    task.waitpoints = 1;
  else if (++task.waitpoints > waitpoints_max)
    return yield_to_ties(task);
  return true;
}

// The task's event is at its local time; returns when it is the least. False if the run is over.
[[gnu::always_inline]] inline bool Scheduler::await_turn(Task& task) {
  if (!agenda_.is_next(task)) {
    switch_fibers(task.fiber, dispatch_instead_of(task));
    return !interrupted_ || answer_interrupt();
  }
  if (task.local_time >= agenda_.until) {
    switch_fibers(task.fiber, wait_for_window(task));
    if (interrupted_ && !answer_interrupt()) return false;
  }
  agenda_.advance(task.local_time);
  if (fast_path_.passes_ties(agenda_.now < agenda_.events.least().key.time))
    fast_path_.open(task, agenda_.now, fast_epoch());
  return true;
}

// The task's event is the one now executing: begins the next segment and executes the event. False if the run is over.
[[gnu::noinline]] bool Scheduler::end_waitpoint(Task& task) {
  if (ended_ != nullptr) reclaim_ended();
  if (interrupted_ && !answer_interrupt()) return false;
  const Operation operation = task.operation;
  Object* const object = task.at;
  if (needs_attention(task) && !begin_segment(task, operation, object)) return false;
  execute(task, operation, object);
  return true;
}

// --- segments: the computation between two waitpoints, see local_clock.hpp ---

// False if the run is over: it may end while the task awaits its shared processor or its duration is recorded.
bool Scheduler::end_segment(Task& task) {
  if (task.clock != nullptr && task.clock->end != nullptr) task.clock->end(*task.clock, task);
  return !unwinding_;
}

// The task continues with `operation`, after the handlers of its pending signals: these take time, so the task awaits
// its turn again after each. False if the run is over.
[[gnu::noinline]] bool Scheduler::begin_segment(Task& task, Operation operation, Object* object) {
  if (task.seat != nullptr && !take_processor(task)) return false;
  while ((task.attention & attention::signal) != 0) {
    task.attention = static_cast<std::uint8_t>(task.attention & ~attention::signal);
    if (task.clock != nullptr && task.clock->begin != nullptr) task.clock->begin(*task.clock, task);
    WAITPOINT_CHECK(hooks_.deliver_signals != nullptr, "a signal is pending without a hook that delivers it");
    hooks_.deliver_signals(task);
    if (unwinding_ || !end_segment(task)) return false;
    task.operation = operation;
    task.at = object;
    if (!await_turn(task)) return false;
  }
  if (task.clock != nullptr && task.clock->begin != nullptr) task.clock->begin(*task.clock, task);
  return true;
}

// --- the least event ---

// Places the task's event and takes the least one out.
inline Fiber& Scheduler::dispatch_instead_of(Task& task) {
  task.state = TaskState::ready;
  if (can_exchange()) return exchange_with_least(task);
  agenda_.place(task, task.local_time);
  return dispatch();
}

// Takes out events in order: calls the actions of timers and messages, and resumes the task of the first other event.
// Returns its fiber, which the caller must switch to; at the end of the window or of the run, the main fiber.
Fiber& Scheduler::dispatch() {
  if (__builtin_expect(agenda_.is_explored(), 0)) return dispatch_explored();
  for (;;) {
    if (agenda_.is_present_next()) {
      Task& task = agenda_.present.take();
      if (agenda_.present.size() >= crowd_min) fetch_coming(agenda_.present);
      return resume(task);
    }
    EventNode* node = agenda_.events.pop_before(agenda_.until);
    if (node == nullptr) return end_window(pending_events() == 0 ? RunState::idle : RunState::reached);
    if (Fiber* fiber = dispatch_event(*node)) return *fiber;
  }
}

// --- sleeping and yielding ---

[[gnu::noinline]] Departure Scheduler::sleep_slow(Time time) {
  if (unwinding_) {
    refuse();
    return stay(Wake::unwinding);
  }
  Task& task = *running;
  fast_path_.close();
  if (needs_attention(task)) {
    WAITPOINT_REQUIRE((task.attention & attention::timer) == 0, "a timer's callback waits");
    if (!end_segment(task)) return stay(Wake::unwinding);
    if (task.seat != nullptr && time > task.local_time) leave_processor(task);
  }
  if (time > task.local_time) task.local_time = time;
  const bool goes_on = announce(task, Operation::sleep, nullptr) && await_turn(task) && end_waitpoint(*running);
  return stay(goes_on ? Wake::woken : Wake::unwinding);
}

bool Scheduler::yield() { return yield_after(1); }

// A yield of the running task, which has passed so many waitpoints since its last one.
bool Scheduler::yield_after(std::uint32_t waitpoints) {
  if (unwinding_) return refuse();
  Task& task = *running;
  fast_path_.close();
  if (needs_attention(task)) {
    WAITPOINT_REQUIRE((task.attention & attention::timer) == 0, "a timer's callback waits");
    if (!end_segment(task)) return false;
    if (task.seat != nullptr) leave_processor(task);
  }
  task.operation = Operation::yield;
  task.at = nullptr;
  if (task.local_time != agenda_.now) task.waitpoints = 0;
  check_progress(task, waitpoints);
  if (unwinding_) return false;
  agenda_.place(task, task.local_time);
  task.state = TaskState::ready;
  switch_fibers(task.fiber, dispatch());
  return end_waitpoint(*running);
}

// Yields to the task's ties, after waitpoints_max waitpoints at one instant. False if the run is over.
bool Scheduler::yield_to_ties(Task& task) {
  task.waitpoints = 1;
  const Operation operation = task.operation;
  Object* const at = task.at;
  if (!yield_after(waitpoints_max)) return false;
  task.operation = operation;
  task.at = at;
  return true;
}

// Stops the run if all tasks of an instant only yield to each other, or exchange something without end.
void Scheduler::check_progress(Task& task, std::uint32_t waitpoints) {
  if (yields_at_ != agenda_.now) {
    yields_at_ = agenda_.now;
    idle_yields_ = waitpoints_at_instant_ = 0;
  }
  if (turn.transferred) idle_yields_ = 0;
  turn.transferred = false;
  waitpoints_at_instant_ += waitpoints;
  if (++idle_yields_ % idle_yields_of_robot == 0) roster_.put_last(*task.robot);
  const bool is_idle = idle_yields_ > idle_yields_max + std::uint64_t{waitpoints_max} * roster_.tasks();
  if (!is_idle && !is_beyond_instant_limit()) return;
  culprit_ = &task;
  stop(StopCause::no_progress);
}

// --- events without a waitpoint ---

bool Scheduler::read_clock_slow(Task& task, Time& local) {
  const Time before = task.local_time;
  local = local_time(task);
  if ((task.attention & attention::timer) != 0) return true;
  fast_path_.close();
  if (local != before)
    task.waitpoints = 0;
  else if (++task.waitpoints > waitpoints_max && !unwinding_ && yield_to_ties(task))
    local = local_time(task);
  return unwinding_ ? refuse() : true;
}

// A timer's callback uses a primitive: it has its turn already, since its event is the one now executing.
bool Scheduler::timer_waitpoint(Task& task, Operation operation, Object* object) {
  task.operation = operation;
  task.at = object;
  if (object != nullptr) enter(*object);
  hash_events_of(*task.robot);
  execute(task, operation, object);
  return true;
}

void Scheduler::execute_start(Task& task) {
  if (needs_attention(task) && !begin_segment(task, Operation::start, nullptr)) return;
  execute(task, Operation::start, nullptr);
}

void Scheduler::record_output(std::uint64_t name, std::uint64_t value) {
  if (unwinding_) return;
  ++running->robot->outputs;
  turn.digest->add(name, value);
}

void Scheduler::show(Operation operation, const Object* object) {
  // Uses of an object synchronise, in their order; accesses to memory do not.
  if (object != nullptr && object->kind != memory_kind && sanitizer::present) sanitizer::use(object);
  if (watch_ != nullptr) watch_->event(*watch_, {agenda_.now, running, operation, object});
  if (debugger_view.watching) show_debugger(agenda_.now, *running, operation, object);
}

}  // namespace waitpoint::kernel
