// SPDX-License-Identifier: BSD-3-Clause
// What is asked of one call of explore().
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "core/time.hpp"

namespace waitpoint {

/// Each is replaced by the environment's WAITPOINT_STRATEGY, _SEED, _ITERATIONS, _TIME_LIMIT and _SCHEDULE_LIMIT
/// (seconds), _REPLAY where that is set.
struct ExploreOptions {
  std::string strategy = "portfolio";
  std::uint64_t seed = 1;
  std::uint64_t iterations = 10'000;    ///< schedules, at most
  double time_limit_s = 0;              ///< of the wall clock; 0: none
  std::uint32_t schedule_limit_s = 60;  ///< of one: what takes longer ends the program; 0: none does
  std::string replay = {};              ///< a token: that schedule alone
  bool races = true;                    ///< a data race is a failure, though it did no harm; see races/races.hpp
  bool minimize = true;                 ///< what failed, to the fewest switches that still fail
  Time until = Time() + std::chrono::hours(1);  ///< a schedule that has not ended then fails
  std::uint32_t steps_max = 100'000;            ///< switch points at one instant, after which there is no progress
};

}  // namespace waitpoint
