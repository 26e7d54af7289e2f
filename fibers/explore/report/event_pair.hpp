// SPDX-License-Identifier: BSD-3-Clause
// Of a run that fails and one that passes, the pair of events whose order matters.
//
//   fails:   ... writer store x | reader load x   ...       up to the bar both runs are one
//   passes:  ... reader load x  | writer store x  ...
//
// Behind where the two runs part, the first event of the failing one that an event of another task at the same object
// comes before where it passes, and did not where it fails: later, or never. Two events are looked at only if their
// order can come to something else (dependence.hpp).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fibers/explore/schedules/event_log.hpp"

namespace waitpoint::exploration {

struct EventPair {
  EventOf failing;          ///< is first where it fails
  EventOf passing;          ///< is first where it passes
  std::size_t indirection;  ///< how many of the two are not the very events at which the runs part
};

/// Of the events of both runs, from where they part or from before. Nothing if there is no such pair: they differ by
/// time, or by what was chosen beside the order of events.
std::optional<EventPair> pair_in_other_order(std::span<const DoneEvent> fails, std::span<const DoneEvent> passes);

/// So many frames of a task's call stack are searched for the user's, and so many of those shown.
inline constexpr std::size_t frames_searched = 24, frames_shown = 4;

/// An event, in words, and below it the calls that its task was in, a line each.
std::string with_calls(const std::string& event, const std::vector<std::string>& calls);

/// Of a pair of them, in lines.
std::string pair_in_words(const std::string& failing, const std::string& passing);
/// That there is none.
std::string no_pair_in_words();

}  // namespace waitpoint::exploration
