// SPDX-License-Identifier: BSD-3-Clause
// One of the possible runs of a target: drawn from (seed, strategy, number), or given by its switches or deviations
// from the default order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "fibers/explore/strategies/reads_from.hpp"
#include "fibers/explore/strategies/schedule.hpp"

namespace waitpoint::exploration {

struct Plan {
  std::uint64_t number = 0;                  ///< of the schedule, for its noise and its draws
  bool drawn = true;                         ///< by the strategy; false: the default order with the deviations below
  std::string strategy = {};                 ///< that draws it, if not that of the options
  std::vector<Switch> switches = {};         ///< each made wherever it fits
  std::vector<Deviation> deviations = {};    ///< alternatives at decisions, before switches
  Constraints constraints = {};              ///< of rff: what earlier schedules have led to
  std::vector<std::uint64_t> progress = {};  ///< of dpor: the search so far, see Dpor
  std::optional<std::size_t> at_random_from = {};  ///< random alternatives after this decision
  std::uint64_t attempt = 0;                       ///< the number of the random continuation
  Time until = Time::max();                        ///< upper limit besides that of the options

  /// The name of the strategy that draws it, where the options have `usual`; empty if none does.
  std::string drawing_strategy(const std::string& usual) const {
    return !drawn ? "" : strategy.empty() ? usual : strategy;
  }
};

}  // namespace waitpoint::exploration
