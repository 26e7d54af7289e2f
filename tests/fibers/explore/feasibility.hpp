// SPDX-License-Identifier: BSD-3-Clause
// Whether a sequence of events can happen within the times that were declared: asked of Z3, by the difference
// constraints of the trace. It knows nothing of how schedules are explored.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/fibers/explore/timed_programs.hpp"

namespace waitpoint::timed {

struct TracedEvent {
  std::uint64_t task;
  std::uint64_t maker;     ///< who made the task; 0: from outside
  std::uint64_t sequence;  ///< of its task's events, from 0
  std::uint64_t object;    ///< 0: none
  bool was_woken;          ///< by the event before at the same object
};

/// The trace of a run up to its failure.
struct Trace {
  std::vector<TracedEvent> events;
  std::vector<TracedEvent> pending;  ///< what tasks that can go on are about to do
  std::vector<Spent> spent;
};

/// Whether dates can be given to the events, ascending, such that each task computed between its events for as long as
/// was declared, and no longer; starts at the time of its maker's first event, and goes on at once when it is woken;
/// and what is pending comes after all.
bool is_feasible(const Trace& trace);

}  // namespace waitpoint::timed
