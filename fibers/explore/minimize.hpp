// SPDX-License-Identifier: BSD-3-Clause
// Minimises a failing schedule: searches for the fewest switches away from the default order that still fail.
//
// First, switches are left out while the rest still fails in the same way (leave_out.hpp), and pairs are replaced by a
// single switch at any place; then all schedules with fewer switches are tried, with one, then two, within the budget.
#pragma once

#include <algorithm>
#include <cstdint>

#include "fibers/explore/body.hpp"

namespace waitpoint::exploration {

/// A failing schedule, and its result.
struct Failure {
  Schedule schedule;
  Outcome outcome;
};

/// True if two outcomes are the same failure: of the same kind and, for failures with a message, with the same message.
bool is_same_failure(const Outcome& a, const Outcome& b);

/// The budget for runs of a body. Not in time, so that a failure always gets the same report.
struct Effort {
  std::uint64_t runs;
  std::uint64_t steps = 30'000'000;  ///< switch points in total: some seconds

  /// True if there is budget for another run.
  bool is_left() const { return runs > 0 && steps > 0; }
  /// Charges one run.
  void spend(const Body& body) {
    --runs;
    steps -= std::min<std::uint64_t>(steps, body.explorer().steps());
  }
};

/// The result fails as `found` does.
Failure minimize(Body& body, const Failure& found, Effort effort);

}  // namespace waitpoint::exploration
