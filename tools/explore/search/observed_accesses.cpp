// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/observed_accesses.hpp"

#include <optional>

namespace waitpoint::tools {
namespace {

// "the write at counter.c:9 and the read at counter.c:9 (counter)", without the name of the kind.
std::string places_of(const ToldRace& race) {
  constexpr std::string_view kind = "data race of ";
  return race.headline.starts_with(kind) ? race.headline.substr(kind.size()) : race.headline;
}

}  // namespace

ObservedAccesses observe_accesses(ProcessTarget& target, bool all_passed) {
  ObservedAccesses observed;
  while (observed.schedules < target.options().observed) {
    Plan plan{.drawn = false};
    if (observed.schedules > 0) plan.at_random_from = 0;
    plan.attempt = observed.schedules;
    const std::optional<Finding> finding = target.run_apart(plan, {.conflicts = true});
    if (!finding) break;
    observed.obstacle = finding->obstacle;
    if (!finding->evidence.races.empty())
      observed.conflict = "no call orders " + places_of(finding->evidence.races.front());
    else if (all_passed && !finding->passed() && observed.obstacle == AccessObstacle::none)
      observed.conflict = "with switches at accesses a schedule fails: " + finding->headline();
    if (!observed.conflict.empty() || observed.obstacle != AccessObstacle::none) break;
    ++observed.schedules;
  }
  return observed;
}

}  // namespace waitpoint::tools
