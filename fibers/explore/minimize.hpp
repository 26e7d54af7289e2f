// SPDX-License-Identifier: BSD-3-Clause
// A failing schedule with as few switches away from the default order as can be found: what is left is what matters.
//
// First switches are left out as long as the rest still fails in the same way (leave_out.hpp), and replaced, two by
// one, wherever that one may be; then all schedules with fewer switches than are left are tried, with one, with two, as
// far as the budget goes.
#pragma once

#include <algorithm>
#include <cstdint>

#include "fibers/explore/body.hpp"

namespace waitpoint::exploration {

/// Where it failed, and how: the schedule, and what it came to.
struct Failure {
  Schedule schedule;
  Outcome outcome;
};

/// Whether two outcomes are the same failure: of one kind, and where it has words of its own, in the same words.
bool is_same_failure(const Outcome& a, const Outcome& b);

/// How much may be spent on running a body. Not in time, so that the same failure always comes to the same report.
struct Effort {
  std::uint64_t runs;
  std::uint64_t steps = 30'000'000;  ///< switch points in all: some seconds

  /// Whether there is enough left for another run.
  bool is_left() const { return runs > 0 && steps > 0; }
  /// A run was done.
  void spend(const Body& body) {
    --runs;
    steps -= std::min<std::uint64_t>(steps, body.explorer().steps());
  }
};

/// What it returns fails as `found` does.
Failure minimize(Body& body, const Failure& found, Effort effort);

}  // namespace waitpoint::exploration
