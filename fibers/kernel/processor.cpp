// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/processor.hpp"

#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/timers.hpp"
#include "fibers/kernel/waiting_calls.hpp"

namespace waitpoint::kernel {
namespace {

bool is_before(const Seat& a, const Seat& b) {
  return a.priority > b.priority || (a.priority == b.priority && a.arrival < b.arrival);
}

// Schedules the assignment of the processor, at the end of this instant.
void decide_later(Processor& processor) {
  if (processor.decision.in_list()) return;
  Scheduler& scheduler = *processor.scheduler;
  schedule(scheduler, processor.decision, global_time(scheduler), processor.object, Phase::processors);
}

void go_on_computing(Seat& seat) {
  Scheduler& scheduler = *seat.processor->scheduler;
  seat.resumed = global_time(scheduler);
  schedule(scheduler, seat.completion, seat.resumed + seat.remaining, seat.processor->object);
}

void complete(EventNode& node) {
  Seat& seat = reinterpret_cast<Seat&>(node);
  seat.computing = false;
  wake(*seat.processor->scheduler, *seat.task);
}

void decide(EventNode& node) {
  Processor& processor = reinterpret_cast<Processor&>(node);
  Scheduler& scheduler = *processor.scheduler;
  Seat* best = nullptr;
  for (Seat* seat = processor.first_seat; seat != nullptr; seat = seat->next)
    if (seat->ready && (best == nullptr || is_before(*seat, *best))) best = seat;
  Seat* user = processor.user;
  if (best == nullptr || best == user) return;
  if (user != nullptr) {
    WAITPOINT_CHECK(user->computing, "a preempted task does not compute");
    cancel(scheduler, user->completion);
    user->remaining -= global_time(scheduler) - user->resumed;
  }
  processor.user = best;
  if (best->computing)
    go_on_computing(*best);
  else
    wake(scheduler, *best->task);
}

// The greatest of the task's own priority and those that its locks lend.
int due_priority(const Seat& seat) {
  int priority = seat.own_priority;
  const auto raise_to = [&priority](int other) { priority = other > priority ? other : priority; };
  for (const PriorityLock* lock = seat.held; lock != nullptr; lock = lock->next) {
    if (lock->protocol == LockProtocol::ceiling) {
      raise_to(lock->ceiling);
      continue;
    }
    for (const Task* waiter = lock->object.first_waiter; waiter != nullptr; waiter = waiter->next_waiter)
      if (waiter->seat != nullptr) raise_to(waiter->seat->priority);
  }
  return priority;
}

}  // namespace

Processor::~Processor() {
  if (decision.in_list()) cancel(*scheduler, decision);
}

void set_seat(Task& task, Seat& seat) {
  seat.task = &task;
  seat.completion.fire = complete;
  task.seat = &seat;
  task.attention |= attention::processor;
}

bool is_shared(const Processor& processor) {
  for (const Task* task = first_task(*running->scheduler); task != nullptr; task = task->next)
    if (task->seat != nullptr && task->seat->processor == &processor) return true;
  return false;
}

void vacate(Task& task) {
  if (task.seat == nullptr) return;
  Processor& processor = *task.seat->processor;
  if (!is_unwinding(*task.scheduler)) {
    leave_processor(task);
    for (Seat** at = &processor.first_seat; *at != nullptr; at = &(*at)->next)
      if (*at == task.seat) {
        *at = task.seat->next;
        break;
      }
  }
  task.seat = nullptr;
  task.attention = static_cast<std::uint8_t>(task.attention & ~attention::processor);
}

bool take_processor(Task& task) {
  Seat& seat = *task.seat;
  Processor& processor = *seat.processor;
  if (enter(processor.object)) {
    processor.scheduler = task.scheduler;
    processor.first_seat = processor.user = nullptr;
    processor.arrivals = 0;
    processor.decision.fire = decide;
  }
  if (processor.user == &seat) return true;
  if (seat.arrival == 0) {
    seat.next = processor.first_seat;
    processor.first_seat = &seat;
  }
  seat.ready = true;
  seat.arrival = ++processor.arrivals;
  decide_later(processor);
  return suspend(processor.object);
}

void leave_processor(Task& task) {
  Seat& seat = *task.seat;
  seat.ready = false;
  if (seat.processor->user != &seat) return;
  seat.processor->user = nullptr;
  decide_later(*seat.processor);
}

bool use_processor(Task& task, Duration cost) {
  Seat& seat = *task.seat;
  WAITPOINT_CHECK(seat.processor->user == &seat, "a task computes on a processor that is not its own");
  if (cost == Duration()) return true;
  seat.computing = true;
  seat.remaining = cost;
  go_on_computing(seat);
  return suspend(seat.processor->object);
}

void hold(Task& task, PriorityLock& lock) {
  if (task.seat == nullptr) return;
  WAITPOINT_REQUIRE(lock.protocol != LockProtocol::ceiling || task.seat->own_priority <= lock.ceiling,
                    "a task holds a mutex whose priority ceiling is below its own priority");
  lock.next = task.seat->held;
  task.seat->held = &lock;
  reconsider_priority(&task);
}

void let_go(Task& task, PriorityLock& lock) {
  if (task.seat == nullptr) return;
  for (PriorityLock** at = &task.seat->held; *at != nullptr; at = &(*at)->next)
    if (*at == &lock) {
      *at = lock.next;
      break;
    }
  reconsider_priority(&task);
}

// Follows the chain of owners. It terminates: each step but the last changes a priority.
void reconsider_priority(Task* task) {
  while (task != nullptr && task->seat != nullptr) {
    Seat& seat = *task->seat;
    const int priority = due_priority(seat);
    if (priority == seat.priority) return;
    seat.priority = priority;
    if (seat.ready) decide_later(*seat.processor);
    task = task->blocked_on != nullptr ? task->blocked_on->owner : nullptr;
  }
}

void lend_priority(Task& task, const Object& object) {
  if (task.seat == nullptr) return;
  leave_processor(task);
  reconsider_priority(object.owner);
}

void take_back_priority(const Task& task, const Object& object) {
  if (task.seat != nullptr) reconsider_priority(object.owner);
}

Task* wake_most_urgent(Scheduler& scheduler, Object& object) {
  if (is_unwinding(scheduler)) return nullptr;
  Task* best = nullptr;
  for (Task* waiter = object.first_waiter; waiter != nullptr; waiter = waiter->next_waiter) {
    if (best == nullptr ||
        (waiter->seat != nullptr && (best->seat == nullptr || waiter->seat->priority > best->seat->priority)))
      best = waiter;
  }
  if (best != nullptr) wake(scheduler, *best);
  return best;
}

}  // namespace waitpoint::kernel
