// SPDX-License-Identifier: BSD-3-Clause
// The cause of a failure in one sentence, for patterns that the events of the failing run show:
//
//   a deadlock   locks in opposite orders, a lost wake-up, a missed notification
//   otherwise    of the two events whose order matters: a lost update, a critical section between two of another
//                task, an access before another's
//
// Each sentence states nothing but events of that run and their order; a pattern is named where a passing run, without
// that order, is known.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "fibers/explore/report/timeline.hpp"

namespace waitpoint::exploration {

/// The two events whose order matters.
struct ReversedOrder {
  EventOf first;           ///< in the failing run
  std::uint64_t follower;  ///< the id of the other event's task
  kernel::Operation then;  ///< its operation, which the failing run may not reach
};

/// What is known of a failing run besides its events.
struct FailureOrder {
  bool is_deadlock;
  bool has_passing_run;
  std::optional<ReversedOrder> reversed;
};

/// Empty if no pattern fits. `timeline`: of the whole failing run.
std::string cause_in_words(const Timeline& timeline, const FailureOrder& order);

}  // namespace waitpoint::exploration
