// SPDX-License-Identifier: BSD-3-Clause
// The two events whose order matters, for a failing run and the last choice from which it could still have passed, with
// both call stacks (fibers/explore/report/reordered_events.hpp).
#pragma once

#include <string>

#include "tools/explore/report/last_choice.hpp"

namespace waitpoint::tools {

/// Text lines. The passing run is the one with the fewest differences among the alternatives at that choice, each
/// followed by the default order; else the run that showed the choice to be the last one. Empty if the budget is
/// exhausted.
std::string reversed_events(Target& target, SearchProgress& progress, Budget& budget, const LeastFailure& least,
                            const LastChoice& choice);

}  // namespace waitpoint::tools
