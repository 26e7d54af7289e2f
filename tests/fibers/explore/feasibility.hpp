// SPDX-License-Identifier: BSD-3-Clause
// Feasibility of a sequence of events within the declared times, decided by Z3 from the difference constraints of the
// trace. Independent of the exploration.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/fibers/explore/timed_programs.hpp"

namespace waitpoint::timed {

struct TracedEvent {
  std::uint64_t task;
  std::uint64_t maker;     ///< id of the task that created this one; 0: created from outside
  std::uint64_t sequence;  ///< number of the event among those of its task, from 0
  std::uint64_t object;    ///< 0: none
  bool was_woken;          ///< by the previous event at the same object
};

/// The trace of a run up to its failure.
struct Trace {
  std::vector<TracedEvent> events;
  std::vector<TracedEvent> pending;  ///< the next events of ready tasks
  std::vector<Spent> spent;
};

/// True if the events can have ascending dates such that each task computes between its events for a time within the
/// declared bounds, starts at the date of the first event of its maker, continues at the date of its wake-up, and the
/// pending events come last.
bool is_feasible(const Trace& trace);

}  // namespace waitpoint::timed
