// SPDX-License-Identifier: BSD-3-Clause
//
// The paper's Algorithm 2, step by step; also the events of timers and messages. fast_calls.cpp has short cuts.
//
//   block(object, deadline)   append the task to the object's waiters; place a timeout if `deadline` is finite
//                             switch to the task of dispatch(), or stop the run if a cycle of waits is closed
//                             woken or timed out: begin the next segment; execute the event
//   wake(task)                remove the task from the waiters, and its timeout from the event list
//                             its local time becomes the global time; place its event there
//   timeout                   dispatch_task() of a blocked task: the same, without a waker
#include "core/error.hpp"
#include "fibers/kernel/processor.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"

namespace waitpoint::kernel {
namespace {

// A choice is among the first waiters only; otherwise waking n waiters one by one would take O(n^2) steps.
constexpr std::uint32_t choice_of_waiters_max = 256;

}  // namespace

void Scheduler::adopt(Object& object) { adopt_as(object, *running->robot, ++running->robot->objects); }

void Scheduler::adopt_as(Object& object, Robot& robot, std::uint32_t number) {
  object.epoch = epoch_;
  object.robot = &robot;
  object.number = number;
  object.identity = child_id(object.robot->id, object.number);
  object.owner = nullptr;
  object.holder_count = object.users = 0;
  object.first_waiter = object.last_waiter = nullptr;
}

// --- Algorithm 2: block, and wake ---

// The running task is among the waiters of `object` until it is woken, or until its timeout, an event at `deadline`, is
// the least event.
[[gnu::noinline]] Departure Scheduler::block_slow(Object& object, Time deadline) {
  if (unwinding_) {
    refuse();
    return stay(Wake::unwinding);
  }
  Task& task = *running;
  WAITPOINT_REQUIRE((task.attention & attention::timer) == 0, "a timer's callback waits");
  fast_path_.close();
  if (sanitizer::present) sanitizer::release(&object);
  append_waiter(object, task);
  if (needs_attention(task)) lend_priority(task, object);
  task.state = TaskState::blocked;
  task.finite_wait = deadline != Time::max();
  if (task.finite_wait) agenda_.place_timeout(task, deadline < agenda_.now ? agenda_.now : deadline);
  Fiber& to = is_deadlock(task, object) ? end_window(RunState::stopped) : dispatch();
  if (departs(task.fiber, to)) return start_switch(task.fiber, to);
  return stay(end_block_slow(*running, object));
}

// The task was woken or its wait timed out: begins the next segment and executes the event.
[[gnu::noinline]] Wake Scheduler::end_block_slow(Task& task, Object& object) {
  if (ended_ != nullptr) reclaim_ended();
  if (interrupted_ && !answer_interrupt()) return Wake::unwinding;
  const Wake wake = task.wake;  // read first: begin_segment() may block again, for the processor
  const Operation operation = wake == Wake::woken ? Operation::resume : Operation::timeout;
  if (needs_attention(task) && !begin_segment(task, operation, &object)) return Wake::unwinding;
  execute(task, operation, &object);
  return wake;
}

// Removes the waiter and its timeout, and places its event at the global time, its new local time.
void Scheduler::wake(Task& task) {
  if (__builtin_expect(sanitizer::present, 0)) sanitizer::release(task.blocked_on);
  remove_waiter(task);
  // In the explored order a task whose timeout is due is in the ready set already; it keeps its place there.
  const bool placed = __builtin_expect(ReadySet::contains(task), 0);
  if (task.finite_wait && !placed) agenda_.events.remove(task.event);
  task.wake = Wake::woken;
  task.state = TaskState::ready;
  set_local_time(task, agenda_.now);
  if (!placed) agenda_.place(task, agenda_.now);
  fast_path_.note_present_event(task.phase);
}

// True if `task` closes a cycle of the wait-for graph and the run ends there.
bool Scheduler::is_deadlock(Task& task, const Object& object) {
  if (task.finite_wait || (object.owner == nullptr && object.holder_count == 0)) return false;
  Task* const member = wait_graph_.find_cycle(task);
  if (member == nullptr) return false;
  culprit_ = member;
  if (hooks_.continues_after_cycle != nullptr && hooks_.continues_after_cycle(task)) {
    culprit_ = nullptr;
    return false;
  }
  cause_ = StopCause::deadlock;
  return true;
}

void Scheduler::move_waiter(Task& task, Object& to) {
  remove_waiter(task);
  append_waiter(to, task);
}

[[gnu::noinline]] Task* Scheduler::wake_one_slow(Object& object) {
  Task* chosen = object.first_waiter;
  if (unwinding_ || object.epoch != epoch_) return nullptr;
  if (agenda_.chooser.order() != Order::fifo) {
    std::uint32_t count = 0;
    for (Task* t = chosen; t != nullptr && count < choice_of_waiters_max; t = t->next_waiter) ++count;
    for (std::uint32_t i = agenda_.chooser.waiter(*running, count); i > 0; --i) chosen = chosen->next_waiter;
  }
  wake(*chosen);
  return chosen;
}

Task* Scheduler::wake_first(Object& object) {
  if (unwinding_ || object.epoch != epoch_ || object.first_waiter == nullptr) return nullptr;
  Task* first = object.first_waiter;
  wake(*first);
  return first;
}

void Scheduler::wake_all(Object& object) {
  if (unwinding_ || object.epoch != epoch_) return;
  while (object.first_waiter != nullptr) wake(*object.first_waiter);
}

// Blocks without executing an event: for processors.
bool Scheduler::suspend(Object& object) {
  if (unwinding_) return false;
  Task& task = *running;
  fast_path_.close();
  append_waiter(object, task);
  task.state = TaskState::blocked;
  task.finite_wait = false;
  switch_fibers(task.fiber, dispatch());
  return !interrupted_ || answer_interrupt();
}

// --- timers and messages ---

void Scheduler::schedule(EventNode& node, Time time, const Object& timer, Phase phase) {
  put(node, {time, make_order(phase, Chooser::tie(timer))});
}

void Scheduler::schedule(EventNode& node, const EventKey& key) { put(node, key); }

void Scheduler::deliver(EventNode& node, Time time, Robot& sender) { deliver(node, time, sender, ++sender.messages); }

void Scheduler::deliver(EventNode& node, Time time, const Robot& sender, std::uint64_t count) {
  put(node, {time, make_order(Phase::deliveries, Chooser::tie(sender, count))});
}

void Scheduler::declare_latency(Duration least) {
  WAITPOINT_REQUIRE(least > Duration(), "a link between robots has no latency");
  if (least < lookahead_) lookahead_ = least;
}

}  // namespace waitpoint::kernel
