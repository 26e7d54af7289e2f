// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/search/race_findings.hpp"

#include <algorithm>

namespace waitpoint::exploration {

std::vector<std::string> RaceFindings::take(const std::vector<ToldRace>& races, const std::string& which,
                                            const std::string& replay) {
  std::vector<std::string> lines;
  for (const ToldRace& race : races) {
    const auto is_it = [&](const Found& found) { return found.race.lines == race.lines; };
    if (std::any_of(found_.begin(), found_.end(), is_it)) continue;
    lines.push_back(which + ": " + race.headline);
    found_.push_back({race, which, replay});
  }
  return lines;
}

std::vector<std::string> RaceFindings::texts() const {
  std::vector<std::string> texts;
  for (const Found& found : found_) texts.push_back(found.text());
  return texts;
}

std::string RaceFindings::besides(const std::vector<ToldRace>& told) const {
  std::string text;
  for (const Found& found : found_) {
    const auto is_it = [&](const ToldRace& race) { return race.lines == found.race.lines; };
    if (std::none_of(told.begin(), told.end(), is_it)) text += "also found, by " + found.text() + "\n";
  }
  return text;
}

}  // namespace waitpoint::exploration
