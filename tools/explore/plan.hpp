// SPDX-License-Identifier: BSD-3-Clause
// One run out of the many that a scenario can have: from (seed, strategy, number) or, for a schedule that was cut
// shorter, from the switches away from the default order that are left of it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/time.hpp"
#include "fibers/explore/strategies/schedule.hpp"

namespace waitpoint::tools {

struct Plan {
  std::uint64_t number = 0;  ///< of the schedule: whose noise it is, and whose draws
  bool drawn = true;         ///< by the strategy; false: the default order, but for what follows
  std::vector<exploration::Switch> switches = {};
  std::vector<exploration::Deviation> deviations = {};
  std::optional<std::size_t> at_random_from = {};  ///< behind this decision any alternative is taken
  std::uint64_t attempt = 0;                       ///< which of the random continuations
  Time until = Time::max();                        ///< it is not followed farther, whatever the options say
};

}  // namespace waitpoint::tools
