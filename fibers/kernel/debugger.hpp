// SPDX-License-Identifier: BSD-3-Clause
// What a debugger is told of the runs of this process, and asks of them.
//
// The debugger reads and writes the one record below and sets breakpoints on the empty functions that are called beside
// it; everything else it reads from the records of task.hpp. Without a debugger `watching` is false and no event comes
// here. While it is true each one does, by the way of those that a Watch sees: what is asked is compared in the process
// itself, some nanoseconds an event, instead of by a breakpoint at each, some ten microseconds.
//
// Nothing here is part of the run: no digest, choice or time depends on it.
#pragma once

#include <cstdint>

#include "core/time.hpp"
#include "fibers/kernel/operation.hpp"

namespace waitpoint::kernel {

class Scheduler;
struct Object;
struct Task;

/// An executed event, as it is compared with that of a replay.
struct SeenEvent {
  Time time;
  std::uint64_t task = 0;    ///< Task::id
  std::uint64_t object = 0;  ///< Object::identity; 0 without one
  Operation operation = Operation::start;
};

struct DebuggerView {
  Scheduler* scheduler = nullptr;  ///< of the run that was entered last; null when it is gone

  // Written by the debugger.
  bool watching = false;                            ///< new runs are; that of `scheduler` if its watched_ is set too
  std::uint64_t stop_at_event = 0;                  ///< by the count `events`
  Time stop_at_time = Time::max();                  ///< the first event then or later
  std::uint64_t stop_at_task = 0;                   ///< the next event of the task with this id
  std::uint64_t checkpoint_at = ~std::uint64_t{0};  ///< the first event from this one on
  bool restarted = false;                           ///< the process goes on from a checkpoint

  // Read by it.
  std::uint64_t events = 0;  ///< seen by now, of all runs
  SeenEvent last, before;    ///< the one now executing, and the one before it
};

extern DebuggerView debugger_view;

/// A run is entered, for the first time or again.
void tell_debugger(Scheduler& scheduler);
/// A run is taken down.
void tell_debugger_of_end(const Scheduler& scheduler);
/// An event is executed, by `task`, while a debugger watches.
void show_debugger(Time now, const Task& task, Operation operation, const Object* object);

}  // namespace waitpoint::kernel
