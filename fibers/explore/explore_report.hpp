// SPDX-License-Identifier: BSD-3-Clause
// What one call of explore() came to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>

#include "fibers/explore/strategies/schedule.hpp"

namespace waitpoint {

struct ExploreReport {
  bool passed = false;
  std::string text;  ///< of a failure: what happened, where, why, and the line that repeats it; else empty
  std::uint64_t schedules = 0;
  std::uint64_t distinct = 0;
  bool complete = false;   ///< all there are were tried, as an exhaustive strategy knows, but for spurious wake-ups
  std::string scope = {};  ///< where an exhaustive strategy came to its end: of what it tried all, in words
  std::size_t leaked_bytes = 0;  ///< of the heap, that the default schedule leaves in use each time
  double seconds = 0;
  std::uint64_t failed_at = 0;     ///< the number of the schedule that failed
  exploration::Schedule schedule;  ///< that failed; the least that was found
  std::string replay;              ///< the token of the failure
};

std::ostream& operator<<(std::ostream& out, const ExploreReport& report);

}  // namespace waitpoint
