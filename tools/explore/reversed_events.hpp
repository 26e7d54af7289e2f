// SPDX-License-Identifier: BSD-3-Clause
// Of a failing run and the last choice from which it could still have passed: the two events whose order matters, with
// the call stacks of both (fibers/explore/report/reordered_events.hpp).
#pragma once

#include <string>

#include "tools/explore/last_choice.hpp"

namespace waitpoint::tools {

/// In lines. What passes is sought among the alternatives at that choice, each with the default order behind it, which
/// leaves the fewest differences; else it is what showed that the choice is the last one. Empty where the budget does
/// not reach.
std::string reversed_events(Target& target, SearchProgress& progress, Budget& budget, const LeastFailure& least,
                            const LastChoice& choice);

}  // namespace waitpoint::tools
