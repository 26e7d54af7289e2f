// SPDX-License-Identifier: BSD-3-Clause
// The data races of a run, if the program is compiled with -fsanitize=thread and the layer has the runtime for it:
// logged as they are found, in the memory that is shared with the explorer's process.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fibers/explore/races/located_race.hpp"

namespace waitpoint::posix {

struct RaceLog {
  std::vector<races::LocatedRace> races;
  std::vector<std::uint64_t> code;  ///< that accesses shared memory, if the run records it
};

/// Called before the scheduler is made; null in a layer without the runtime. `code` comes from an earlier run.
RaceLog* start_race_log(bool learn, std::span<const std::uint64_t> code);

}  // namespace waitpoint::posix
