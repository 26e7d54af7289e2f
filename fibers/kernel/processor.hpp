// SPDX-License-Identifier: BSD-3-Clause
// Processors shared by tasks: fixed priorities, preemptive, first-in-first-out within a priority (POSIX: SCHED_FIFO).
//
// A task with a seat on a processor continues only while it is the processor's user. A computation is a request for
// processor time, completed by an event at its end, which is cancelled when another task preempts:
//
//   low   |== computing ==|                     |== the rest ==|
//   high                  |woken, takes over ===|blocks
//
// The processor is assigned after all other events of an instant (Phase::processors): of the tasks that became ready at
// one instant the most urgent one continues first, regardless of their ties. So a user is only preempted while it
// computes.
//
// A holder of locks with a protocol has at least the priority of their most urgent waiter (inheritance, transitively),
// or of their ceilings. (Liu, Layland, JACM 1973; Sha, Rajkumar, Lehoczky, IEEE TC 1990.)
#pragma once

#include "fibers/kernel/lock_protocol.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

struct PriorityLock;
struct Processor;

/// The place of one task on a processor. Seat and processor must outlive the task.
struct Seat {
  Seat(Processor& of, int at_priority) : processor(&of), own_priority(at_priority), priority(at_priority) {}
  Seat(const Seat&) = delete;
  Seat& operator=(const Seat&) = delete;

  EventNode completion;  // first: the node's address is the seat's
  Processor* processor;
  Task* task = nullptr;
  Seat* next = nullptr;  ///< the next seat of the processor
  PriorityLock* held = nullptr;
  std::uint64_t arrival = 0;  ///< counts the arrivals at the processor: the order within a priority
  Time resumed;               ///< the time when it last began or continued to compute
  Duration remaining;         ///< the remaining cost of its computation, at `resumed`
  int own_priority;
  int priority;        ///< including that lent by its locks; greater is more urgent
  bool ready = false;  ///< uses the processor or waits for it
  bool computing = false;
};

struct Processor {
  explicit constexpr Processor(const char* label) : object("processor", label) {}
  /// Cancels a decision that the last leave_processor() scheduled.
  ~Processor();
  Processor(const Processor&) = delete;
  Processor& operator=(const Processor&) = delete;

  EventNode decision;  // first: the node's address is the processor's
  Object object;       ///< its waiters are the tasks that wait for the processor or compute on it
  Scheduler* scheduler = nullptr;
  Seat* first_seat = nullptr;
  Seat* user = nullptr;
  std::uint64_t arrivals = 0;
};

/// The part of a mutex that lends priority to its holder.
struct PriorityLock {
  Object& object;
  LockProtocol protocol;
  int ceiling = 0;
  PriorityLock* next = nullptr;  ///< the next lock held by the same task
};

/// Sets the seat of `task`, which must not have started.
void set_seat(Task& task, Seat& seat);
/// True if a task of the present run has a seat on `processor`.
bool is_shared(const Processor& processor);
/// Frees the seat of `task`, which ends.
void vacate(Task& task);

/// Blocks the running task until it is the user of its processor. False if the run is over.
bool take_processor(Task& task);
/// Releases the processor: the running task is about to block, sleep or yield.
void leave_processor(Task& task);
/// The running task computes for `cost` of processor time, including preemptions by others. False if the run is over.
bool use_processor(Task& task, Duration cost);

/// `task`, not necessarily running, holds `lock` now, or no longer.
void hold(Task& task, PriorityLock& lock);
void let_go(Task& task, PriorityLock& lock);
/// Recomputes the priority of `task` and along its chain of owners, after a change of waiters; null: no effect.
void reconsider_priority(Task* task);
/// The running task has become a waiter of `object`: it releases its processor and lends its priority to the owner.
void lend_priority(Task& task, const Object& object);
/// The wait of `task` for `object` has timed out: its owner may lose the priority that was lent.
void take_back_priority(const Task& task, const Object& object);
/// Wakes the most urgent waiter of `object`, the first of equals; null if there is none.
Task* wake_most_urgent(Scheduler& scheduler, Object& object);

}  // namespace waitpoint::kernel
