// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/search/enumeration.hpp"

#include <utility>

#include "core/error.hpp"
#include "fibers/explore/strategies/factory.hpp"

namespace waitpoint::exploration {

Enumeration::Enumeration(std::string strategy)
    : name_(std::move(strategy)),
      strategy_(make_strategy(name_)),
      dfs_(dynamic_cast<Dfs*>(strategy_.get())),
      dpor_(dynamic_cast<Dpor*>(strategy_.get())) {
  WAITPOINT_CHECK(dfs_ != nullptr || dpor_ != nullptr, "a strategy that draws is to enumerate");
}

Enumeration Enumeration::after_draws(const char* strategy) {
  Enumeration enumeration{std::string(strategy)};
  enumeration.after_draws_ = strategy;
  return enumeration;
}

Plan Enumeration::plan() const {
  if (dfs_ != nullptr) return {.drawn = false, .deviations = dfs_->deviations()};
  Plan plan{.strategy = name_};
  if (number_ > 0) plan.progress = dpor_->progress();
  return plan;
}

bool Enumeration::take(const RunVerdict& verdict, std::span<const Decision> choices, const Finding* apart) {
  const bool is_lost = verdict.kind == RunVerdict::Kind::killed;
  if (!is_lost && apart != nullptr && !resume(apart->lesson)) return false;
  ++number_;
  is_broken_ = is_lost;
  is_over_ = is_lost || !strategy_->end();
  omissions_.take(verdict, choices);
  return true;
}

bool Enumeration::resume(const Lesson& lesson) {
  if (dfs_ != nullptr) {
    dfs_->resume(lesson.choices);
  } else if (!lesson.progress.empty()) {
    dpor_->resume(lesson.progress);
  } else if (after_draws_ != nullptr) {
    return false;
  } else {
    throw BadInput(
        "--strategy",
        "expected dfs or bounded:K, as the program starts processes or other programs, found '" + name_ + "'");
  }
  return true;
}

std::optional<std::string> Enumeration::scope() const {
  if (is_broken_ || !unproved().empty()) return std::nullopt;
  return (dpor_ != nullptr ? up_to_equivalence : strategy_->scope()) + omissions_.in_words();
}

}  // namespace waitpoint::exploration
