// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/race_discoveries.hpp"

#include <algorithm>

namespace waitpoint::tools {
std::vector<std::string> RaceDiscoveries::take(const Finding& finding, const std::string& which,
                                               const std::string& replay) {
  std::vector<std::string> lines;
  for (const ToldRace& race : finding.races) {
    const bool is_known =
        std::any_of(found_.begin(), found_.end(), [&](const Found& found) { return found.race.lines == race.lines; });
    if (is_known) continue;
    lines.push_back(which + ": " + race.headline);
    found_.push_back({race, which, replay});
  }
  return lines;
}

std::string RaceDiscoveries::besides(const std::vector<ToldRace>& told) const {
  std::string text;
  for (const Found& found : found_)
    if (std::none_of(told.begin(), told.end(), [&](const ToldRace& race) { return race.lines == found.race.lines; }))
      text += "also found, by " + found.which + ": " + found.race.text + "replay: " + found.replay + "\n";
  return text;
}

}  // namespace waitpoint::tools
