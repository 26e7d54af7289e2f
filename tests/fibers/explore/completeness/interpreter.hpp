// SPDX-License-Identifier: BSD-3-Clause
// Programs on the library's primitives, under the schedules of a strategy.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "fibers/explore/strategies/reads_from.hpp"
#include "tests/fibers/explore/completeness/machine.hpp"

namespace waitpoint::completeness {

struct Covered {
  Outcomes outcomes;
  std::uint64_t schedules = 0;
  bool is_finished = false;   ///< the strategy has nothing left to try
  bool leaves_turns = false;  ///< it says that it left out turns of spinning tasks
};

/// The outcomes of `program` under all schedules of `strategy`, or the first `schedules_max`.
Covered cover(const Program& program, const std::string& strategy, std::uint64_t schedules_max);

/// Calls `take` with the reads-from pairs of each of so many schedules of `random`.
void draw(const Program& program, std::uint64_t schedules,
          const std::function<void(std::span<const exploration::ReadsFrom> pairs)>& take);

}  // namespace waitpoint::completeness
