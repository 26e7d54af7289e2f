// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/races/distinct_races.hpp"

#include <algorithm>

#include "fibers/explore/races/runtime.hpp"

namespace waitpoint::races {

std::vector<Race> DistinctRaces::take() {
  if (!any_found()) return {};
  const FoundRace* races = nullptr;
  const std::size_t count = waitpoint_races_runtime()->found(races);
  bool is_new = false;
  for (std::size_t i = 0; i < count; ++i)
    is_new = code_.insert(std::minmax({races[i].first.access.place, races[i].second.access.place})).second || is_new;
  if (!is_new) return {};
  std::vector<Race> all = found();
  std::erase_if(all, [this](const Race& race) { return !lines_.insert(race.lines()).second; });
  return all;
}

}  // namespace waitpoint::races
