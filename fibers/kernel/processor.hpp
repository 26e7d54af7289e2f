// SPDX-License-Identifier: BSD-3-Clause
// Processors that tasks share by fixed priority, preemptively, first in first out within a priority (POSIX:
// SCHED_FIFO).
//
// A task with a seat on a processor goes on only while it is the processor's user. What it computes is a request for so
// much of the processor's time, served by an event at its end, which is taken back when another task preempts:
//
//   low   |== computing ==|                     |== the rest ==|
//   high                  |woken, takes over ===|blocks
//
// Who uses the processor is decided once all else of an instant is done: of the tasks that became ready at one instant
// the most urgent goes on first, whatever the order of their ties. So a user is only ever preempted while it computes.
//
// A task that holds locks with a protocol is as urgent as the most urgent task that waits for one of them (inheritance,
// transitively), or as their ceilings say. (Liu, Layland, JACM 1973; Sha, Rajkumar, Lehoczky, IEEE TC 1990.)
#pragma once

#include "fibers/kernel/lock_protocol.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

struct PriorityLock;
struct Processor;

/// The place of one task on a processor; both outlive the task.
struct Seat {
  Seat(Processor& of, int at_priority) : processor(&of), own_priority(at_priority), priority(at_priority) {}
  Seat(const Seat&) = delete;
  Seat& operator=(const Seat&) = delete;

  EventNode completion;  // first: the node is its seat
  Processor* processor;
  Task* task = nullptr;
  Seat* next = nullptr;  ///< of the processor
  PriorityLock* held = nullptr;
  std::uint64_t arrival = 0;  ///< when it became ready, as a count: who was first among equals
  Time resumed;               ///< when it last went on computing
  Duration remaining;         ///< of what it computes
  int own_priority;
  int priority;        ///< with what its locks give it; the greater is the more urgent
  bool ready = false;  ///< uses the processor or waits for it
  bool computing = false;
};

struct Processor {
  explicit constexpr Processor(const char* label) : object("processor", label) {}
  /// Who left it last may have left a decision to make at the end of this instant.
  ~Processor();
  Processor(const Processor&) = delete;
  Processor& operator=(const Processor&) = delete;

  EventNode decision;  // first: the node is its processor
  Object object;       ///< whose waiters are the tasks that wait or compute
  Scheduler* scheduler = nullptr;
  Seat* first_seat = nullptr;
  Seat* user = nullptr;
  std::uint64_t arrivals = 0;
};

/// A lock that lends its holder urgency: part of a mutex.
struct PriorityLock {
  Object& object;
  LockProtocol protocol;
  int ceiling = 0;
  PriorityLock* next = nullptr;  ///< held by the same task
};

/// Gives `task`, which has not started, its seat.
void set_seat(Task& task, Seat& seat);
/// Whether a task of the running run has a seat on `processor`.
bool is_shared(const Processor& processor);
/// The running task ends: its seat is free.
void vacate(Task& task);

/// The running task goes on once it is the user of its processor; false when the run is over.
bool take_processor(Task& task);
/// The running task blocks, sleeps or gives way.
void leave_processor(Task& task);
/// The running task computes for `cost`, and whatever others take meanwhile; false when the run is over.
bool use_processor(Task& task, Duration cost);

/// `task`, which need not run, holds `lock` now, or holds it no longer.
void hold(Task& task, PriorityLock& lock);
void let_go(Task& task, PriorityLock& lock);
/// What `task` inherits may have changed, or whom it waits for; null: nobody.
void reconsider_priority(Task* task);
/// Wakes the most urgent waiter of `object`, of these the first; null if there is none.
Task* wake_most_urgent(Scheduler& scheduler, Object& object);

}  // namespace waitpoint::kernel
