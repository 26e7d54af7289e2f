// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/target/finding.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

namespace waitpoint::exploration {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Without the task and the time of an escaped exception, and without numbers: these differ from schedule to schedule.
// Those of source lines remain: "lock.cpp:12".
std::string essence(std::string_view headline) {
  if (const std::size_t said = headline.find(" s: "); said != std::string_view::npos) headline = headline.substr(said);
  std::string text;
  for (std::size_t i = 0; i < headline.size(); ++i) {
    const bool is_number = is_digit(headline[i]) || headline[i] == '.';
    const bool follows_line = !text.empty() && (text.back() == ':' || is_digit(text.back()));
    if (!is_number || (is_digit(headline[i]) && follows_line)) text += headline[i];
  }
  return text;
}

}  // namespace

ToldRace told(const races::Race& race, const std::string& process) {
  std::ostringstream text;
  text << race;
  const races::Lines lines = race.lines();
  return {lines.first + "\n" + lines.second, headline(race) + (process.empty() ? "" : " in " + process), text.str()};
}

void Finding::take(const Schedule& schedule, bool has_parted) {
  decisions = schedule.decisions.size();
  cuts_polls_short = schedule.cuts_polls_short;
  parted = has_parted;
  if (passed()) return;
  switches = schedule.switches;
  deviations = schedule.deviations();
}

bool is_same_failure(const Finding& a, const Finding& b) {
  using Kind = RunVerdict::Kind;
  if (a.passed() || a.kind != b.kind) return false;
  if (a.kind == Kind::deadlock || a.kind == Kind::no_progress) return true;
  if (a.kind == Kind::race && !a.racing.empty())
    return std::find_first_of(a.racing.begin(), a.racing.end(), b.racing.begin(), b.racing.end()) != a.racing.end();
  return essence(a.headline()) == essence(b.headline());
}

}  // namespace waitpoint::exploration
