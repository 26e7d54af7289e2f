// SPDX-License-Identifier: BSD-3-Clause
// The last choice of a failing run from which it could still have passed.
//
// A run could still have passed at a choice if one of a few random continuations from there on does. Between the last
// switch, without which it passes, and the failure, where nothing helps, the place is found by halves.
#pragma once

#include <optional>
#include <string>

#include "tools/explore/budget.hpp"
#include "tools/explore/search.hpp"

namespace waitpoint::tools {

/// In words: "number 1234, at 12.100000000 s: segloc.slam of rackham computes 33 ms in place of 95 ms". Nothing where
/// the budget does not reach, or the failure needs no switch. `least` failed with the noise of schedule `number`.
std::optional<std::string> last_choice(Target& target, SearchProgress& progress, Budget& budget, std::uint64_t number,
                                       const Finding& least);

}  // namespace waitpoint::tools
