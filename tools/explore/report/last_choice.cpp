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

// Random continuations of a failing run, within a budget.
class Continuations {
 public:
  Continuations(Target& target, SearchProgress& progress, Budget& budget, const LeastFailure& least)
      : target_(target), progress_(progress), budget_(budget), least_(least) {}

  /// One that passes, of the run up to that decision; `left` are the choices in question, for the progress.
  std::optional<Plan> passing(std::size_t decision, std::size_t left) {
    for (std::uint64_t attempt = 0; attempt < continuations; ++attempt) {
      Plan plan = least_.plan_up_to(decision);
      plan.at_random_from = decision;
      plan.attempt = attempt;
      is_over_ = is_over_ || !budget_.take();
      if (is_over_) return std::nullopt;
      progress_.update(fmt::format("explaining: {} choices left, run {}", left, budget_.used()));
      const std::optional<Finding> tried = run_apart(target_, plan);
      is_over_ = !tried;
      if (tried && tried->passed()) return plan;
    }
    return std::nullopt;
  }
  /// The budget is exhausted, or the search interrupted.
  bool is_over() const { return is_over_; }

 private:
  Target& target_;
  SearchProgress& progress_;
  Budget& budget_;
  const LeastFailure& least_;
  bool is_over_ = false;
};

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
  Continuations random(target, progress, budget, least);
  std::size_t passes = 0, fails = finding.decisions;
  std::optional<Plan> passing;
  if (finding.deviations.empty()) {
    passing = random.passing(passes, fails);
  } else {
    passes = finding.deviations.back().decision;
    passing = least.plan_up_to(passes);
  }
  while (passing && fails - passes > 1) {
    const std::size_t middle = passes + (fails - passes) / 2;
    const std::optional<Plan> found = random.passing(middle, fails - passes);
    if (random.is_over()) return std::nullopt;
    (found ? passes : fails) = middle;
    if (found) passing = found;
  }
  if (!passing) return std::nullopt;
  const std::optional<Finding> told = run_apart(target, least.plan(), {.decision = passes});
  if (!told || told->told.empty()) return std::nullopt;
  return LastChoice{passes, *passing, fmt::format("number {}, {}", passes, told->told)};
}

}  // namespace waitpoint::tools
