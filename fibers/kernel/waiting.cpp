// SPDX-License-Identifier: BSD-3-Clause
//
// Waiting on objects and being woken (the paper's Algorithm 2), and the events of timers and messages.
#include "core/error.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"

namespace waitpoint::kernel {
namespace {

// Of more waiters one of the first is woken: to wake each of many would else take the square of their number.
constexpr std::uint32_t choice_of_waiters_max = 256;

}  // namespace

void Scheduler::adopt(Object& object) {
  object.epoch = epoch_;
  object.robot = running->robot;
  object.number = ++object.robot->objects;
  object.identity = child_id(object.robot->id, object.number);
  object.owner = nullptr;
  object.holder_count = object.users = 0;
  object.first_waiter = object.last_waiter = nullptr;
}

// The task waits from now on: the fiber to leave for.
Fiber& Scheduler::park(Task& task, Object& object, Time deadline) {
  free_pass_.end();
  if (sanitizer::present) sanitizer::release(&object);
  append_waiter(object, task);
  if (needs_attention(task)) start_waiting(task, object);
  if (!stay_until(task, object, deadline)) return outside(RunState::stopped);
  return next_fiber();
}

void Scheduler::wake(Task& task) { make_ready(task); }

void Scheduler::move_waiter(Task& task, Object& to) {
  remove_waiter(task);
  append_waiter(to, task);
}

// As make_ready() of the first, where that is all. What is rare is left to a function that is called last: each
// register that is kept over a call is saved first.
Task* Scheduler::wake_a_waiter(Object& object) {
  Task& first = *object.first_waiter;
  const bool is_usual = __builtin_expect(ordinary_, 1) && object.epoch == epoch_ && first.phase == Phase::tasks;
  if (__builtin_expect(!is_usual, 0)) return choose_waiter(object);
  if (first.finite_wait && __builtin_expect(!agenda_.events.remove_at_once(first.event), 0))
    return choose_waiter(object);
  remove_first_waiter(object);
  first.wake = Wake::woken;
  first.state = TaskState::ready;
  set_local_time(first, agenda_.now);
  agenda_.present.add(first, agenda_.chooser.tie_of_next());
  return &first;
}

[[gnu::noinline]] Task* Scheduler::choose_waiter(Object& object) {
  Task* chosen = object.first_waiter;
  if (unwinding_ || object.epoch != epoch_) return nullptr;
  if (agenda_.chooser.order() != Order::fifo) {
    std::uint32_t count = 0;
    for (Task* t = chosen; t != nullptr && count < choice_of_waiters_max; t = t->next_waiter) ++count;
    for (std::uint32_t i = agenda_.chooser.waiter(*running, count); i > 0; --i) chosen = chosen->next_waiter;
  }
  make_ready(*chosen);
  return chosen;
}

Task* Scheduler::wake_first(Object& object) {
  if (unwinding_ || object.epoch != epoch_ || object.first_waiter == nullptr) return nullptr;
  Task* first = object.first_waiter;
  make_ready(*first);
  return first;
}

void Scheduler::wake_all(Object& object) {
  if (unwinding_ || object.epoch != epoch_) return;
  while (object.first_waiter != nullptr) make_ready(*object.first_waiter);
}

void Scheduler::schedule(EventNode& node, Time time, const Object& timer, Phase phase) {
  put(node, {time, make_order(phase, Chooser::tie(timer))});
}

void Scheduler::deliver(EventNode& node, Time time, Robot& sender) {
  put(node, {time, make_order(Phase::deliveries, Chooser::tie(sender, ++sender.messages))});
}

void Scheduler::declare_latency(Duration least) {
  WAITPOINT_CHECK(least > Duration(), "a link between robots has no latency");
  if (least < lookahead_) lookahead_ = least;
}

}  // namespace waitpoint::kernel
