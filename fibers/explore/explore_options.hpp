// SPDX-License-Identifier: BSD-3-Clause
// The options of one call of explore().
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "core/time.hpp"
#include "fibers/explore/races_option.hpp"
#include "fibers/explore/strategies/memory_option.hpp"

namespace waitpoint {

/// Overridden by the environment's WAITPOINT_STRATEGY, _SEED, _ITERATIONS, _TIME_LIMIT and _SCHEDULE_LIMIT (seconds),
/// _RACES, _MEMORY, _REPLAY where set.
struct ExploreOptions {
  std::string strategy = "portfolio";
  std::uint64_t seed = 1;
  std::uint64_t iterations = 10'000;    ///< greatest number of schedules
  double time_limit_s = 0;              ///< wall-clock time of the campaign; 0: no limit
  std::uint32_t schedule_limit_s = 60;  ///< wall-clock time of one schedule, after which the program ends; 0: no limit
  std::string replay = {};              ///< a token: runs that schedule only
  Races races = Races::report;          ///< what follows from a data race, even without an effect; see races/races.hpp
  Memory memory = Memory::sc;           ///< of code compiled with -fsanitize=thread
  bool minimize = true;                 ///< reduces a failing schedule to the fewest switches that still fail
  Time until = Time() + std::chrono::hours(1);  ///< virtual time at which an unfinished schedule fails
  std::uint32_t steps_max = 100'000;            ///< greatest number of switch points at one instant; more is no
                                                ///< progress
};

}  // namespace waitpoint
