// SPDX-License-Identifier: BSD-3-Clause
// The last choice of a failing run from which it could still have passed.
//
// Of a cheap target it is searched backwards from the end: the last one with an alternative that passes when the
// default order follows. Of another one, a run could still have passed at a choice if one of a few random continuations
// from there passes. Bisection finds the choice between the last switch, without which the run passes, and the failure,
// after which no continuation does. If the default order fails, it begins with the run's first choice.
#pragma once

#include <optional>
#include <string>

#include "fibers/explore/analysis/trials.hpp"

namespace waitpoint::exploration {

/// A failed run, with the noise of schedule `number`.
struct LeastFailure {
  std::uint64_t number;
  const Finding& finding;
  Time until;  ///< of other runs: TargetTraits::latest()

  /// The plan that repeats it.
  Plan plan() const;
  /// The same up to that decision, another alternative there (if none is given: the same), then the default order.
  Plan plan_up_to(std::size_t decision, std::optional<std::uint32_t> instead = {}) const;
};

struct LastChoice {
  std::size_t decision;
  Plan passing;                               ///< the same up to there, and a passing continuation
  std::optional<std::uint32_t> instead = {};  ///< the alternative there that passes, if it is known
  std::string words = {};  ///< "number 1234, at 12.100000000 s: segloc.slam of rackham computes 33 ms instead of 95 ms"
};

/// Nothing if the budget is exhausted, or no passing run is found.
std::optional<LastChoice> last_choice(Target& target, Trials& trials, const LeastFailure& least);

}  // namespace waitpoint::exploration
