// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/race_findings.hpp"

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace waitpoint::exploration {

void RaceFindings::take(const std::string& which, const std::string& replay) {
  for (races::Race& race : distinct_.take()) {
    std::fprintf(stderr, "waitpoint: %s: %s\n", which.c_str(), headline(race).c_str());
    found_.push_back({std::move(race), which, replay});
  }
}

std::string RaceFindings::Found::text() const {
  std::ostringstream text;
  text << which << ": " << race << replay;
  return text.str();
}

std::vector<std::string> RaceFindings::texts() const {
  std::vector<std::string> texts;
  for (const Found& found : found_) texts.push_back(found.text());
  return texts;
}

std::string RaceFindings::besides(const std::vector<races::Race>& told) const {
  std::string text;
  for (const Found& found : found_) {
    const auto is_it = [&](const races::Race& race) { return race.lines() == found.race.lines(); };
    if (std::none_of(told.begin(), told.end(), is_it)) text += "\nalso found, by " + found.text();
  }
  return text;
}

}  // namespace waitpoint::exploration
