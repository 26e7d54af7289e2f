// SPDX-License-Identifier: BSD-3-Clause
// Finds the pair of events whose order distinguishes a failing run from a passing one.
//
//   fails:   ... writer store x | reader load x   ...       up to the bar both runs are the same
//   passes:  ... reader load x  | writer store x  ...
//
// After the runs diverge, it is the first event of the failing run that follows an event of another task at the same
// object in the passing run, but precedes it, or lacks it, in the failing one; else the first event of the failing run
// that the passing one ends without, before an event of both. Only dependent events are considered (dependence.hpp).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fibers/explore/schedules/event_log.hpp"

namespace waitpoint::exploration {

struct EventPair {
  DoneEvent failing;        ///< first in the failing run
  DoneEvent passing;        ///< first in the passing run
  std::size_t indirection;  ///< the number of the two that are not the events at which the runs diverge
};

/// Takes the events of both runs, from the divergence or earlier. None if there is no such pair: the runs differ by
/// time, or by choices other than the order of events.
std::optional<EventPair> pair_in_other_order(std::span<const DoneEvent> fails, std::span<const DoneEvent> passes);

/// The number of frames of a task's call stack to search for the user's, and of those to show.
inline constexpr std::size_t frames_searched = 24, frames_shown = 4;

/// An event as text, followed by the calls of its task, a line each.
std::string with_calls(const std::string& event, const std::vector<std::string>& calls);

/// A pair of them, as lines.
std::string pair_in_words(const std::string& failing, const std::string& passing);
/// The text if there is none.
std::string no_pair_in_words();

}  // namespace waitpoint::exploration
