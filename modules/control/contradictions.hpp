// SPDX-License-Identifier: BSD-3-Clause
// Contradictions of rules, found when they are loaded: a condition that can never hold, a state that the controller
// could not leave, a request that could never be accepted, checks that demand opposite things.
//
// States are overestimated: each predicate has the set of values that it may have in any run, which grows until no
// request is accepted that was not before (a relaxed reachability analysis). So a contradiction found is one, but not
// each is found: those that depend on the order of several requests are not.
#pragma once

#include "modules/control/automaton.hpp"
#include "modules/control/rules.hpp"

namespace waitpoint::control {

/// BadInput for the first contradiction of the rules, from which `automaton` was compiled. If all checks together need
/// too many nodes, only contradictions of single checks are found.
void check_contradictions(const Rules& rules, Automaton automaton);

}  // namespace waitpoint::control
