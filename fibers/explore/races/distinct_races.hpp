// SPDX-License-Identifier: BSD-3-Clause
// The races of several runs, each once: a race is known by the two source lines of its accesses.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fibers/explore/races/races.hpp"

namespace waitpoint::races {

class DistinctRaces {
 public:
  /// The races of the last run that are new. Looks up source lines only for code that is new.
  std::vector<Race> take();

 private:
  std::set<std::pair<std::uint64_t, std::uint64_t>> code_;
  std::set<Lines> lines_;
};

}  // namespace waitpoint::races
