// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/expectation.hpp"

#include <fmt/format.h>

#include <limits>

#include "core/number_text.hpp"

namespace waitpoint::run {
namespace {

std::string goals_text(const bridge::RunTotals& sum) {
  return fmt::format("{} of {} goals reached", sum.goals_reached, sum.goals);
}

// ": robot ada: REASON".
std::string first_abort(const bridge::RunResult& result) {
  for (const bridge::RobotResult& robot : result.robots)
    if (robot.plan && !robot.plan->completed) return ": robot " + robot.name + ": " + robot.plan->end;
  return "";
}

// `value`, which exceeds `limit`, with at least three digits and enough to differ from it.
std::string greater_text(double value, double limit) {
  for (int digits = 3; digits < std::numeric_limits<double>::max_digits10; ++digits)
    if (std::string text = fmt::format("{:.{}g}", value, digits); text != fmt::format("{:.{}g}", limit, digits))
      return text;
  return fmt::format("{}", value);
}

}  // namespace

std::vector<std::string> broken(const scenario::Expectation& expect, const bridge::RunTotals& figures) {
  std::vector<std::string> lines;
  if (expect.goals_reached && figures.goals_reached > *expect.goals_reached)
    lines.push_back(goals_text(figures) + ", expected " + std::to_string(*expect.goals_reached));
  if (expect.collisions && figures.collisions > *expect.collisions)
    lines.push_back(fmt::format("{}, expected {}", counted(figures.collisions, "collision"), *expect.collisions));
  if (expect.position_error_max_m && !(figures.position_error_max_m <= *expect.position_error_max_m))
    lines.push_back(fmt::format("position error of {} m, expected at most {:g} m",
                                greater_text(figures.position_error_max_m, *expect.position_error_max_m),
                                *expect.position_error_max_m));
  return lines;
}

std::vector<std::string> unmet(const scenario::Expectation& expect, const bridge::RunResult& result) {
  const bridge::RunTotals sum = bridge::totals(result);
  std::vector<std::string> others = broken(expect, sum);
  others.insert(others.end(), result.outside_unmet.begin(), result.outside_unmet.end());
  std::vector<std::string> lines;
  if (result.outcome == bridge::Outcome::deadlock) lines.push_back("the run ended in a deadlock");
  if (result.outcome == bridge::Outcome::no_progress) lines.push_back("the run made no progress");
  // A run that a partner has ended for another reason had no time to reach them.
  if (result.outcome == bridge::Outcome::left && !result.outside.empty() && !others.empty()) return others;
  if (expect.all_goals_reached && sum.goals_reached != sum.goals) lines.push_back(goals_text(sum) + ", expected all");
  if (expect.goals_reached && sum.goals_reached < *expect.goals_reached)
    lines.push_back(goals_text(sum) + ", expected " + std::to_string(*expect.goals_reached));
  if (expect.collisions && sum.collisions < *expect.collisions)
    lines.push_back(fmt::format("{}, expected {}", counted(sum.collisions, "collision"), *expect.collisions));
  if (expect.plans_completed && sum.plans_completed != sum.plans)
    lines.push_back(
        fmt::format("{} of {} plans completed, expected all{}", sum.plans_completed, sum.plans, first_abort(result)));
  for (std::string& line : others) lines.push_back(std::move(line));
  return lines;
}

}  // namespace waitpoint::run
