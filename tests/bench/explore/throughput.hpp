// SPDX-License-Identifier: BSD-3-Clause
// Number of schedules of the body run in some time, and number of distinct ones.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/kernel/meter.hpp"

namespace waitpoint::bench {

struct Speed {
  double schedules = 0, distinct = 0, switch_points = 0, seconds = 0;
};

/// Result of one schedule: its switch points and digest.
using Done = std::pair<double, std::uint64_t>;

/// Runs schedules for `seconds` of that clock; `run` executes the schedule with the given number.
template <class Run>
Speed carry_on(double seconds, Clock clock, Run run) {
  Speed speed;
  std::vector<std::uint64_t> seen;
  seen.reserve(std::size_t{1} << 18);  // excludes allocation from the measured time
  const std::int64_t start_ns = clock_ns(clock);
  do {
    for (int i = 0; i < 16; ++i, ++speed.schedules) {
      const auto [switch_points, digest] = run(static_cast<std::uint64_t>(speed.schedules));
      speed.switch_points += switch_points;
      seen.push_back(digest);
    }
    speed.seconds = 1e-9 * static_cast<double>(clock_ns(clock) - start_ns);
  } while (speed.seconds < seconds);
  std::sort(seen.begin(), seen.end());
  speed.distinct = static_cast<double>(std::unique(seen.begin(), seen.end()) - seen.begin());
  return speed;
}

/// The fastest of several attempts of `run(seconds)`, `seconds` in total.
template <class Run>
Speed best_of_some(double seconds, Run run) {
  constexpr int goes = 5;
  Speed best = run(seconds / goes);
  for (int i = 1; i < goes; ++i) {
    const Speed speed = run(seconds / goes);
    if (speed.schedules / speed.seconds > best.schedules / best.seconds) best = speed;
  }
  return best;
}

/// contend() under the named strategy, at one address for all measurements.
Speed by_strategy(const std::string& name, double seconds);

}  // namespace waitpoint::bench
