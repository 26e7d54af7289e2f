// SPDX-License-Identifier: BSD-3-Clause
// The data races of a run, where the program is compiled with -fsanitize=thread and the layer has the runtime for it:
// written down as they are found, in the memory that is shared with who asks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fibers/explore/races/located_race.hpp"

namespace waitpoint::posix {

struct RaceLog {
  std::vector<races::LocatedRace> races;
  std::vector<std::uint64_t> code;  ///< that accesses what threads share, where the run was to learn it
};

/// Before the scheduler is made; null in a layer without the runtime. `code` is what an earlier run has learned.
RaceLog* start_race_log(bool learn, std::span<const std::uint64_t> code);

}  // namespace waitpoint::posix
