// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/analysis/last_choice.hpp"

#include "core/number_text.hpp"

namespace waitpoint::exploration {
namespace {

// Continuations tried for each candidate choice.
constexpr std::uint64_t continuations = 4;

// A random continuation that passes, of the run up to that decision; `left` are the choices in question, for the
// progress.
std::optional<Plan> passing_by_chance(Trials& trials, const LeastFailure& least, std::size_t decision,
                                      std::size_t left) {
  for (std::uint64_t attempt = 0; attempt < continuations; ++attempt) {
    Plan plan = least.plan_up_to(decision);
    plan.at_random_from = decision;
    plan.attempt = attempt;
    const std::optional<Finding> tried =
        trials.run(plan, {}, [&] { return "explaining: " + counted(left, "choice") + " left"; });
    if (!tried) return std::nullopt;
    if (tried->passed()) return plan;
  }
  return std::nullopt;
}

std::optional<LastChoice> by_bisection(Trials& trials, const LeastFailure& least) {
  const Finding& finding = least.finding;
  std::size_t passes = 0, fails = finding.decisions;
  std::optional<Plan> passing;
  if (finding.deviations.empty()) {
    passing = passing_by_chance(trials, least, passes, fails);
  } else {
    passes = finding.deviations.back().decision;
    passing = least.plan_up_to(passes);
  }
  while (passing && fails - passes > 1) {
    const std::size_t middle = passes + (fails - passes) / 2;
    const std::optional<Plan> found = passing_by_chance(trials, least, middle, fails - passes);
    if (trials.is_over()) return std::nullopt;
    (found ? passes : fails) = middle;
    if (found) passing = found;
  }
  if (!passing) return std::nullopt;
  return LastChoice{passes, *passing};
}

std::optional<LastChoice> by_all_alternatives(Trials& trials, const LeastFailure& least) {
  const auto words = [] { return std::string("explaining"); };
  const std::optional<Finding> failing = trials.run(least.plan(), {.choices = true}, words);
  if (!failing) return std::nullopt;
  const std::vector<Decision>& decisions = failing->lesson.choices;
  for (std::size_t i = decisions.size(); i-- > 0;) {
    // As in Continuation.
    if (decisions[i].choice == kernel::Choice::spurious && !decisions[i].is_switch()) continue;
    for (std::uint32_t other = 0; other < decisions[i].count; ++other) {
      if (other == decisions[i].chosen) continue;
      const Plan plan = least.plan_up_to(i, other);
      const std::optional<Finding> tried = trials.run(plan, {}, words);
      if (!tried) return std::nullopt;
      if (tried->passed()) return LastChoice{i, plan, other};
    }
  }
  return std::nullopt;
}

}  // namespace

Plan LeastFailure::plan() const { return {.number = number, .drawn = false, .deviations = finding.deviations}; }

Plan LeastFailure::plan_up_to(std::size_t decision, std::optional<std::uint32_t> instead) const {
  Plan plan{.number = number, .drawn = false, .until = until};
  for (const Deviation& deviation : finding.deviations)
    if (deviation.decision < decision) plan.deviations.push_back(deviation);
  if (instead) plan.deviations.push_back({static_cast<std::uint32_t>(decision), *instead});
  return plan;
}

std::optional<LastChoice> last_choice(Target& target, Trials& trials, const LeastFailure& least) {
  std::optional<LastChoice> choice =
      trials.traits().is_cheap ? by_all_alternatives(trials, least) : by_bisection(trials, least);
  if (!choice) return std::nullopt;
  const auto told = target.repeat(least.plan(), {.decision = choice->decision, .instead = choice->instead});
  if (!told || told->evidence.told.empty()) return std::nullopt;
  choice->words = "number " + std::to_string(choice->decision) + ", " + told->evidence.told;
  return choice;
}

}  // namespace waitpoint::exploration
