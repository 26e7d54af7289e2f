// SPDX-License-Identifier: BSD-3-Clause
// A race whose addresses are expressed by modules, offsets and symbols, valid beyond the process.
#pragma once

#include <string>

#include "fibers/explore/races/runtime.hpp"
#include "fibers/sync/report/source_lines.hpp"

namespace waitpoint::races {

struct LocatedRace {
  FoundRace found;
  std::string memory;  ///< as in Race
  sync::CodePlaces first_calls, second_calls;
};

/// Converts a race of this process.
LocatedRace located(const FoundRace& race);

}  // namespace waitpoint::races
