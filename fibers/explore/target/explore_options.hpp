// SPDX-License-Identifier: BSD-3-Clause
// The options of an exploration: of a call of explore(), and the ones that `waitpoint explore` has in common with it.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "core/time.hpp"
#include "fibers/explore/strategies/memory_option.hpp"
#include "fibers/explore/target/races_option.hpp"

namespace waitpoint {

/// Overridden by the environment's WAITPOINT_STRATEGY, _SEED, _ITERATIONS, _TIME_LIMIT and _SCHEDULE_LIMIT (seconds),
/// _RACES, _MEMORY, _REPLAY where set.
struct ExploreOptions {
  static constexpr double usual_schedule_limit_s = 60;

  std::string strategy = "portfolio";
  std::uint64_t seed = 1;
  std::uint64_t iterations = 10'000;  ///< greatest number of schedules
  double time_limit_s = 0;            ///< wall-clock time of the search; 0: no limit
  /// Wall-clock time of one schedule, after which a body's program ends and another target's schedule fails; 0: no
  /// limit. By default that of usual_schedule_limit_s; of a scenario or a program with ten times the default order's.
  std::optional<double> schedule_limit_s = {};
  std::string replay = {};      ///< a token (of `waitpoint explore`, or a file's name): runs that schedule only
  Races races = Races::report;  ///< what follows from a data race, even without an effect; see races/races.hpp
  Memory memory = Memory::sc;   ///< of code compiled with -fsanitize=thread
  bool minimize = true;         ///< reduces a failing schedule to the fewest switches that still fail
  Time until = Time() + std::chrono::hours(1);  ///< virtual time at which an unfinished schedule of a body fails
  std::uint32_t steps_max = 100'000;            ///< greatest number of switch points at one instant; more is no
                                                ///< progress
};

}  // namespace waitpoint
