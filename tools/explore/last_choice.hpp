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

/// A run that failed, with the noise of schedule `number`.
struct LeastFailure {
  std::uint64_t number;
  const Finding& finding;

  /// It once more.
  Plan plan() const;
  /// The same up to that decision, and there, unless nothing is said, another alternative; then the default order.
  Plan plan_up_to(std::size_t decision, std::optional<std::uint32_t> instead = {}) const;
};

struct LastChoice {
  std::size_t decision;
  Plan passing;       ///< the same up to there, and then one that passes
  std::string words;  ///< "number 1234, at 12.100000000 s: segloc.slam of rackham computes 33 ms in place of 95 ms"
};

/// Nothing where the budget does not reach, or the failure needs no switch.
std::optional<LastChoice> last_choice(Target& target, SearchProgress& progress, Budget& budget,
                                      const LeastFailure& least);

}  // namespace waitpoint::tools
