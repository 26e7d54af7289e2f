// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/report/last_choice.hpp"

#include <fmt/format.h>

#include "tools/explore/search/search.hpp"

namespace waitpoint::tools {
namespace {

// Continuations tried for each candidate choice.
constexpr std::uint64_t continuations = 4;
// A run that survives the other's failure by this much counts as passed.
constexpr Duration survival = std::chrono::seconds(5);

}  // namespace

Plan LeastFailure::plan() const { return {.number = number, .drawn = false, .deviations = finding.deviations}; }

Plan LeastFailure::plan_up_to(std::size_t decision, std::optional<std::uint32_t> instead) const {
  Plan plan{.number = number, .drawn = false, .until = finding.end + survival};
  for (const exploration::Deviation& deviation : finding.deviations)
    if (deviation.decision < decision) plan.deviations.push_back(deviation);
  if (instead) plan.deviations.push_back({static_cast<std::uint32_t>(decision), *instead});
  return plan;
}

std::optional<LastChoice> last_choice(Target& target, SearchProgress& progress, Budget& budget,
                                      const LeastFailure& least) {
  const Finding& finding = least.finding;
  if (finding.deviations.empty()) return std::nullopt;
  std::size_t passes = finding.deviations.back().decision, fails = finding.decisions;
  Plan passing = least.plan_up_to(passes);
  while (fails - passes > 1) {
    const std::size_t middle = passes + (fails - passes) / 2;
    bool passed = false;
    for (std::uint64_t attempt = 0; attempt < continuations && !passed; ++attempt) {
      if (!budget.take()) return std::nullopt;
      progress.update(fmt::format("explaining: {} choices left, run {}", fails - passes, budget.used()));
      Plan plan = least.plan_up_to(middle);
      plan.at_random_from = middle;
      plan.attempt = attempt;
      const std::optional<Finding> tried = run_apart(target, plan);
      if (!tried) return std::nullopt;
      passed = tried->passed();
      if (passed) passing = plan;
    }
    (passed ? passes : fails) = middle;
  }
  const std::optional<Finding> told = run_apart(target, least.plan(), {.decision = passes});
  if (!told || told->told.empty()) return std::nullopt;
  return LastChoice{passes, passing, fmt::format("number {}, {}", passes, told->told)};
}

}  // namespace waitpoint::tools
