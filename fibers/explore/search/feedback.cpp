// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/search/feedback.hpp"

#include <algorithm>

#include "fibers/explore/strategies/factory.hpp"

namespace waitpoint::exploration {

Feedback::Feedback(const std::string& strategy, std::uint64_t seed)
    : strategy_(make_strategy(strategy)), seed_(seed), next_(strategy_->first_held(0)) {}

// From a whole generation; false while some of it has not ended.
bool Feedback::learn() {
  if (lessons_.size() < generation) return true;
  if (!std::ranges::all_of(lessons_, [](const auto& lesson) { return lesson.second.pairs.has_value(); })) return false;
  for (auto& [number, lesson] : lessons_) {
    Draws draws(seed_, "what is learned", number);
    corpus_.learn(std::move(lesson.constraints), *lesson.pairs, draws);
  }
  lessons_.clear();
  return true;
}

std::optional<Plan> Feedback::plan_of_next() {
  if (!learn()) return std::nullopt;
  Draws draws(seed_, "constraints", next_);
  Plan plan{.number = next_, .constraints = corpus_.draw(draws)};
  lessons_[next_].constraints = plan.constraints;
  next_ = strategy_->first_held(next_ + 1);
  return plan;
}

void Feedback::take(std::uint64_t number, const Finding& finding) { lessons_[number].pairs = finding.lesson.pairs; }

Plan Feedback::plan_of(std::uint64_t number, const std::function<Finding(const Plan& plan)>& run) {
  if (!is_learned(number)) return {.number = number};
  for (;;) {
    const Plan plan = *plan_of_next();
    if (plan.number == number) return plan;
    take(plan.number, run(plan));
  }
}

}  // namespace waitpoint::exploration
