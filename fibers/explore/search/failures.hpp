// SPDX-License-Identifier: BSD-3-Clause
// What a search does with failing schedules.
#pragma once

#include <string>

#include "fibers/explore/target/finding.hpp"

namespace waitpoint::exploration {

/// True if the search goes on after such a failure, to one of a graver kind. `reports_races`: by Races::report.
inline bool goes_on_after(RunVerdict::Kind kind, bool reports_races) {
  return kind == RunVerdict::Kind::misuse || (kind == RunVerdict::Kind::race && reports_races);
}

/// "schedule 2 of strategy portfolio, seed 1".
inline std::string name_of_schedule(std::uint64_t number, const std::string& strategy, std::uint64_t seed) {
  return "schedule " + std::to_string(number) + " of strategy " + strategy + ", seed " + std::to_string(seed);
}

}  // namespace waitpoint::exploration
