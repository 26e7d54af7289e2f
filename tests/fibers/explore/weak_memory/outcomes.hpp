// SPDX-License-Identifier: BSD-3-Clause
// The outcomes of a litmus test by exploration.
#pragma once

#include <cstdint>
#include <string>

#include "fibers/explore/strategies/memory_option.hpp"
#include "tests/fibers/explore/weak_memory/litmus.hpp"

namespace waitpoint::weak_memory {

struct Explored {
  Outcomes outcomes;
  std::uint64_t schedules = 0;
  std::string scope;  ///< as in ExploreReport
  std::string text;   ///< of the report, if it failed
};

/// All schedules of an exhaustive strategy, or so many.
Explored explored(const Litmus& litmus, const std::string& strategy, Memory memory,
                  std::uint64_t iterations = 10'000'000);

}  // namespace waitpoint::weak_memory
