// SPDX-License-Identifier: BSD-3-Clause
// A race with its addresses in words that outlive the process: modules, offsets, names of symbols.
#pragma once

#include <string>

#include "fibers/explore/races/runtime.hpp"
#include "fibers/sync/source_lines.hpp"

namespace waitpoint::races {

struct LocatedRace {
  FoundRace found;
  std::string memory;  ///< of Race
  sync::CodePlaces first_calls, second_calls;
};

/// Of a race in this process.
LocatedRace located(const FoundRace& race);

}  // namespace waitpoint::races
