// SPDX-License-Identifier: BSD-3-Clause
//
// The paper's Algorithm 2, step by step. fast_calls.cpp has short cuts.
//
//   block(object, deadline)   append the task to the object's waiters; place a timeout if `deadline` is finite
//                             switch to the task of dispatch(), or stop the run if a cycle of waits is closed
//                             woken or timed out: begin the next segment; execute the event
//   wake(task)                remove the task from the waiters, and its timeout from the event list
//                             its local time becomes the global time; place its event there
//   timeout                   dispatch_task() of a blocked task: the same, without a waker
#include "fibers/kernel/waiting_calls.hpp"

#include "core/error.hpp"
#include "fibers/kernel/processor.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"

namespace waitpoint::kernel {
namespace {

// A choice is among the first waiters only; otherwise waking n waiters one by one would take O(n^2) steps.
constexpr std::uint32_t choice_of_waiters_max = 256;

// True if `task` closes a cycle of the wait-for graph and the run ends there.
bool is_deadlock(Scheduler& scheduler, Task& task, const Object& object) {
  if (task.finite_wait || (object.owner == nullptr && object.holder_count == 0)) return false;
  Task* const member = scheduler.wait_graph.find_cycle(task);
  if (member == nullptr) return false;
  RunWindow& window = scheduler.window;
  window.culprit = member;
  const auto continues = scheduler.hooks.continues_after_cycle;
  if (continues != nullptr && continues(task)) {
    window.culprit = nullptr;
    return false;
  }
  window.cause = StopCause::deadlock;
  return true;
}

}  // namespace

void adopt(Object& object) { adopt_as(*running->scheduler, object, *running->robot, ++running->robot->objects); }

void adopt_as(Scheduler& scheduler, Object& object, Robot& robot, std::uint32_t number) {
  object.epoch = scheduler.epoch;
  object.robot = &robot;
  object.number = number;
  object.identity = child_id(object.robot->id, object.number);
  object.owner = nullptr;
  object.holder_count = object.users = 0;
  object.first_waiter = object.last_waiter = nullptr;
}

bool has_entered(const Scheduler& scheduler, const Object& object) { return object.epoch == scheduler.epoch; }

// --- Algorithm 2: block, and wake ---

// The running task is among the waiters of `object` until it is woken, or until its timeout, an event at `deadline`, is
// the least event.
[[gnu::noinline]] Departure block_slow(Scheduler& scheduler, Object& object, Time deadline) {
  if (scheduler.interruption.is_unwinding) {
    refuse();
    return stay(Wake::unwinding);
  }
  Task& task = *running;
  WAITPOINT_REQUIRE((task.attention & attention::timer) == 0, "a timer's callback waits");
  turn.close();
  if (sanitizer::present) sanitizer::release(&object);
  append_waiter(object, task);
  if (needs_attention(task)) lend_priority(task, object);
  task.state = TaskState::blocked;
  task.finite_wait = deadline != Time::max();
  if (task.finite_wait)
    scheduler.agenda.place_timeout(task, deadline < scheduler.agenda.now ? scheduler.agenda.now : deadline);
  Fiber& to = is_deadlock(scheduler, task, object) ? end_window(scheduler, RunState::stopped) : dispatch(scheduler);
  if (departs(scheduler, task.fiber, to)) return start_switch(task.fiber, to);
  return stay(end_block_slow(scheduler, *running, object));
}

// The task was woken or its wait timed out: begins the next segment and executes the event.
[[gnu::noinline]] Wake end_block_slow(Scheduler& scheduler, Task& task, Object& object) {
  if (scheduler.ended != nullptr) reclaim_ended(scheduler);
  if (scheduler.interruption.is_pending && !answer_interrupt(scheduler)) return Wake::unwinding;
  const Wake wake = task.wake;  // read first: begin_segment() may block again, for the processor
  const Operation operation = wake == Wake::woken ? Operation::resume : Operation::timeout;
  if (needs_attention(task) && !begin_segment(scheduler, task, operation, &object)) return Wake::unwinding;
  execute(scheduler, task, operation, &object);
  return wake;
}

// Removes the waiter and its timeout, and places its event at the global time, its new local time.
void wake(Scheduler& scheduler, Task& task) {
  if (__builtin_expect(sanitizer::present, 0)) sanitizer::release(task.blocked_on);
  remove_waiter(task);
  // In the explored order a task whose timeout is due is in the ready set already; it keeps its place there.
  const bool placed = __builtin_expect(ReadySet::contains(task), 0);
  if (task.finite_wait && !placed) scheduler.agenda.events.remove(task.event);
  task.wake = Wake::woken;
  task.state = TaskState::ready;
  set_local_time(task, scheduler.agenda.now);
  if (!placed) scheduler.agenda.place(task, scheduler.agenda.now);
  scheduler.fast_path.note_present_event(task.phase);
}

void move_waiter(Task& task, Object& to) {
  remove_waiter(task);
  append_waiter(to, task);
}

[[gnu::noinline]] Task* wake_one_slow(Scheduler& scheduler, Object& object) {
  Task* chosen = object.first_waiter;
  if (scheduler.interruption.is_unwinding || object.epoch != scheduler.epoch) return nullptr;
  if (scheduler.agenda.chooser.order() != Order::fifo) {
    std::uint32_t count = 0;
    for (Task* t = chosen; t != nullptr && count < choice_of_waiters_max; t = t->next_waiter) ++count;
    for (std::uint32_t i = scheduler.agenda.chooser.waiter(*running, count); i > 0; --i) chosen = chosen->next_waiter;
  }
  wake(scheduler, *chosen);
  return chosen;
}

Task* wake_first(Scheduler& scheduler, Object& object) {
  if (scheduler.interruption.is_unwinding || object.epoch != scheduler.epoch || object.first_waiter == nullptr)
    return nullptr;
  Task* first = object.first_waiter;
  wake(scheduler, *first);
  return first;
}

void wake_all(Scheduler& scheduler, Object& object) {
  if (scheduler.interruption.is_unwinding || object.epoch != scheduler.epoch) return;
  while (object.first_waiter != nullptr) wake(scheduler, *object.first_waiter);
}

bool suspend(Object& object) {
  Task& task = *running;
  Scheduler& scheduler = *task.scheduler;
  if (scheduler.interruption.is_unwinding) return false;
  turn.close();
  append_waiter(object, task);
  task.state = TaskState::blocked;
  task.finite_wait = false;
  switch_fibers(scheduler, task.fiber, dispatch(scheduler));
  return !scheduler.interruption.is_pending || answer_interrupt(scheduler);
}

}  // namespace waitpoint::kernel
