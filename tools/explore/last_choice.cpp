// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/last_choice.hpp"

#include <fmt/format.h>

namespace waitpoint::tools {
namespace {

using exploration::Deviation;

// Of each choice that is looked at.
constexpr std::uint64_t continuations = 4;
// It has passed that long after the time at which the other failed.
constexpr Duration longer = std::chrono::seconds(5);

std::vector<Deviation> before(const std::vector<Deviation>& all, std::size_t decision) {
  std::vector<Deviation> some;
  for (const Deviation& deviation : all)
    if (deviation.decision < decision) some.push_back(deviation);
  return some;
}

}  // namespace

std::optional<std::string> last_choice(Target& target, SearchProgress& progress, Budget& budget, std::uint64_t number,
                                       const Finding& least) {
  if (least.deviations.empty()) return std::nullopt;
  std::size_t passes = least.deviations.back().decision, fails = least.decisions;
  while (fails - passes > 1) {
    const std::size_t middle = passes + (fails - passes) / 2;
    bool passed = false;
    for (std::uint64_t attempt = 0; attempt < continuations && !passed; ++attempt) {
      if (!budget.take()) return std::nullopt;
      progress.update(fmt::format("explaining: {} choices left, run {}", fails - passes, budget.used()));
      const std::optional<Finding> tried = run_apart(target, {.number = number,
                                                              .drawn = false,
                                                              .deviations = before(least.deviations, middle),
                                                              .at_random_from = middle,
                                                              .attempt = attempt,
                                                              .until = least.end + longer});
      if (!tried) return std::nullopt;
      passed = tried->passed();
    }
    (passed ? passes : fails) = middle;
  }
  const std::optional<Finding> told =
      run_apart(target, {.number = number, .drawn = false, .deviations = least.deviations}, {.decision = passes});
  if (!told || told->told.empty()) return std::nullopt;
  return fmt::format("number {}, {}", passes, told->told);
}

}  // namespace waitpoint::tools
