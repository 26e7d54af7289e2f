// SPDX-License-Identifier: BSD-3-Clause
// The scheduler is the event list (the paper's Algorithms 1 and 2). This is its record: the state of one run, part by
// part, each beside the functions that own it. Only the kernel's sources and who makes a scheduler include it; other
// layers have a reference, and the functions of the headers named below.
//
// Every primitive begins with waitpoint(): the task's event is in the list at its local virtual time, and the task
// continues when that event is the least. The global time is the time of the event now executing; it never decreases.
// So all uses of primitives happen in the order of virtual time, regardless of the computation in between.
//
// Hand-over is direct, from the fiber that cannot continue to the fiber of the least event. A task whose own event is
// the least does not switch. The context that called run_before(), the main fiber, is re-entered only when the run
// stops.
//
// The plain path is waitpoint.cpp and waiting.cpp; waitpoint_calls.hpp and fast_calls.cpp have short cuts to the same
// events.
//
// The scheduler throws nothing, prints nothing, and allocates nothing while running.
#pragma once

#include <cstdint>

#include "core/time.hpp"
#include "fibers/kernel/agenda.hpp"
#include "fibers/kernel/fast_path.hpp"
#include "fibers/kernel/hooks.hpp"
#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/roster.hpp"
#include "fibers/kernel/run_progress.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/wait_graph.hpp"
#include "fibers/kernel/watch.hpp"
#include "fibers/switch/reserved_pages.hpp"
#include "fibers/switch/stack_arena.hpp"

namespace waitpoint::kernel {

class Scheduler {
 public:
  Scheduler(Order order, std::uint64_t seed);
  /// Unwinds the remaining tasks.
  ~Scheduler();
  Scheduler(const Scheduler&) = delete;
  Scheduler& operator=(const Scheduler&) = delete;

  /// After unwind(): the state of a new scheduler of this seed, without robots; its memory is kept. Takes a
  /// microsecond.
  void restart(std::uint64_t seed);

  /// True if there is enough address space to construct a scheduler (ulimit -v).
  static bool has_address_space() { return !kept_pages().empty() || EventList::has_address_space(events_max); }
  /// Reserves the address space of a scheduler of the explored order, which the next one in this process, or in a
  /// forked one, gets: as it would have reserved it.
  static void reserve_ahead();

  /// The epoch of the objects that the running task may use by the fast path: none while a watch or other work is
  /// pending.
  std::uint64_t fast_epoch() const {
    return watching.is_on || interruption.is_pending || ended != nullptr ? Turn::no_epoch : epoch;
  }

  Agenda agenda;              ///< the pending events in their order, and the present instant
  FastPath fast_path;         ///< if the running task may pass waitpoints without a search
  StackArena arena;           ///< the stacks of its tasks (tasks.hpp)
  RunWindow window;           ///< the call of run_before(): its end, stop and pause
  Task* ended = nullptr;      ///< its stack is in use until the next switch is done (tasks.cpp)
  Watching watching;          ///< who is shown each event
  Interruption interruption;  ///< resumed tasks do not continue: they unwind, or are visited
  Hooks hooks;                ///< attachments of the layers above
  WaitGraph wait_graph;       ///< the search for deadlocks
  std::uint64_t epoch;        ///< distinguishes this run's objects from those of other runs of the process
  std::uint64_t switches = 0;
  RunProgress progress;                      ///< the yields at the present instant
  Duration least_latency = Duration::max();  ///< of all links between robots (messages.hpp)
  Roster roster;                             ///< the robots and tasks
};

}  // namespace waitpoint::kernel
