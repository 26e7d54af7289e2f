// SPDX-License-Identifier: BSD-3-Clause
// The interface between a debugger and the runs of this process.
//
// The debugger reads and writes the record DebuggerView and sets breakpoints on the empty functions called beside it;
// everything else it reads from the records of task.hpp. Without a debugger `watching` is false and no event is shown
// here. With one, each event is shown, as to a Watch, and compared with the debugger's conditions in this process: some
// nanoseconds an event, in place of some ten microseconds for a breakpoint.
//
// No digest, choice or time depends on it. The view is of the process: of several runs in several threads, the one
// entered last.
#pragma once

#include <cstdint>

#include "core/time.hpp"
#include "fibers/kernel/operation.hpp"

namespace waitpoint::kernel {

class Scheduler;
struct Object;
struct Task;

/// An executed event, for comparison with a replay's.
struct SeenEvent {
  Time time;
  std::uint64_t task = 0;    ///< Task::id
  std::uint64_t object = 0;  ///< Object::identity; 0 without one
  Operation operation = Operation::start;
};

struct DebuggerView {
  Scheduler* scheduler = nullptr;  ///< of the run that was entered last; null after its destruction

  // Written by the debugger.
  bool watching = false;            ///< for new runs; the run of `scheduler` needs its Watching::is_on set too
  std::uint64_t stop_at_event = 0;  ///< stop at this value of `events`
  Time stop_at_time = Time::max();  ///< stop at the first event at this time or later
  std::uint64_t stop_at_task = 0;   ///< stop at the next event of the task with this id
  std::uint64_t checkpoint_at = ~std::uint64_t{0};  ///< make a checkpoint when `events` reaches this value
  bool restarted = false;                           ///< the process was restarted from a checkpoint

  // Read by the debugger.
  std::uint64_t events = 0;  ///< number of events shown so far, of all runs
  SeenEvent last, before;    ///< the event now executing, and the previous one
};

extern DebuggerView debugger_view;

/// A run is entered, for the first time or after a pause.
void tell_debugger(Scheduler& scheduler);
/// A run is destroyed.
void tell_debugger_of_end(const Scheduler& scheduler);
/// `task` executes an event while a debugger is watching.
void show_debugger(Time now, const Task& task, Operation operation, const Object* object);

}  // namespace waitpoint::kernel
