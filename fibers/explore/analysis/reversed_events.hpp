// SPDX-License-Identifier: BSD-3-Clause
// The two events whose order matters, for a failing run and the last choice from which it could still have passed, with
// both call stacks (fibers/explore/report/reordered_events.hpp).
#pragma once

#include <optional>
#include <string>

#include "fibers/explore/analysis/last_choice.hpp"
#include "fibers/explore/report/reordered_events.hpp"

namespace waitpoint::exploration {

struct ReversedEvents {
  std::string text;                  ///< lines; empty if the budget is exhausted
  std::optional<Plan> passing = {};  ///< of the passing run; nothing if the budget is exhausted
  std::optional<EventPair> pair = {};
  Time from = {};  ///< of the pair, when the earlier one happens
};

/// The passing run is the one with the fewest differences among the alternatives at that choice, each followed by the
/// default order; else the run that showed the choice to be the last one.
ReversedEvents reversed_events(Trials& trials, const LeastFailure& least, const LastChoice& choice);

}  // namespace waitpoint::exploration
