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

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fibers/explore/body.hpp"

namespace waitpoint::exploration {

struct DoneEvent {
  EventOf event;
  kernel::Operation operation;
  std::uint64_t object;  ///< its identity, which is of use within one run; 0: none
};

/// The events of a run of `body` by these decisions, and then in the default order.
std::vector<DoneEvent> events_of(Body& body, std::span<const Decision> decisions);

struct EventPair {
  EventOf failing;          ///< is first where it fails
  EventOf passing;          ///< is first where it passes
  std::size_t indirection;  ///< how many of the two are not the very events at which the runs part
};

/// Nothing if there is no such pair: the runs differ by time, or by what was chosen beside the order of events.
std::optional<EventPair> pair_in_other_order(std::span<const DoneEvent> fails, std::span<const DoneEvent> passes);

}  // namespace waitpoint::exploration
