// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/expectation.hpp"

namespace waitpoint::bridge {

std::vector<std::string> unmet(const Expectation& expect, const RunResult& result) {
  std::vector<std::string> lines;
  const RunTotals sum = totals(result);
  const std::string reached = std::to_string(sum.goals_reached) + " of " + std::to_string(sum.goals) + " goals reached";
  if (result.outcome == Outcome::deadlock) lines.push_back("the run ended in a deadlock");
  if (result.outcome == Outcome::no_progress) lines.push_back("the run made no progress");
  if (expect.all_goals_reached && sum.goals_reached != sum.goals) lines.push_back(reached + ", expected all");
  if (expect.goals_reached && *expect.goals_reached != sum.goals_reached) {
    lines.push_back(reached + ", expected " + std::to_string(*expect.goals_reached));
  }
  if (expect.collisions && *expect.collisions != sum.collisions) {
    lines.push_back(std::to_string(sum.collisions) + " collisions, expected " + std::to_string(*expect.collisions));
  }
  return lines;
}

}  // namespace waitpoint::bridge
