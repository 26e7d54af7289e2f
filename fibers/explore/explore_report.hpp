// SPDX-License-Identifier: BSD-3-Clause
// The result of one call of explore().
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "fibers/explore/search/new_pair_chance.hpp"
#include "fibers/explore/strategies/schedule.hpp"

namespace waitpoint {

struct ExploreReport {
  bool passed = false;
  std::string text;  ///< of a failure: its description, location, explanation and replay line; else empty
  std::uint64_t schedules = 0;
  std::uint64_t distinct = 0;  ///< that differ in more than the order of independent events
  bool complete = false;       ///< an exhaustive strategy has tried all schedules, except spurious wake-ups
  std::string scope = {};      ///< after an exhaustive search: the space searched, as text
  /// Where not all schedules were tried: how likely another one shows something new; nothing if too few were drawn
  /// independently.
  std::optional<exploration::NewPairChance> chance_of_news = {};
  std::size_t leaked_bytes = 0;  ///< heap bytes leaked by each default schedule
  double seconds = 0;
  std::uint64_t failed_at = 0;     ///< number of the failing schedule
  exploration::Schedule schedule;  ///< the smallest failing schedule found
  std::string replay;              ///< token of the failure
  /// With Races::report: the distinct data races, each with its schedule; those of a failed report are in `text`, too.
  std::vector<std::string> races;
};

std::ostream& operator<<(std::ostream& out, const ExploreReport& report);

}  // namespace waitpoint
