// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/analysis/reversed_events.hpp"

#include <algorithm>
#include <utility>

namespace waitpoint::exploration {
namespace {

// Limit of alternatives tried: the durations of a computation are many and much alike.
constexpr std::uint32_t alternatives_max = 8;

class Comparison {
 public:
  Comparison(Trials& trials, const LeastFailure& least, const LastChoice& choice)
      : trials_(trials), least_(least), choice_(choice) {}

  ReversedEvents found() {
    std::optional<Finding> failing = log_of(least_.plan());
    if (!failing) return {};
    fails_ = std::move(failing->evidence.log);
    for (std::uint32_t other = 0; other < alternatives_max && !is_plainest(); ++other) {
      const std::optional<Finding> tried = log_of(least_.plan_up_to(choice_.decision, other));
      if (!tried || tried->parted) break;  // no further alternatives
      consider(least_.plan_up_to(choice_.decision, other), *tried);
    }
    if (!passes_)
      if (const std::optional<Finding> tried = log_of(choice_.passing)) consider(choice_.passing, *tried);
    if (!passes_) return {};
    if (!pair_) return {no_pair_in_words(), passes_};
    const std::optional<Finding> first = before(least_.plan(), pair_->failing.event),
                                 second = before(*passes_, pair_->passing.event);
    if (!first || !second) return {"", passes_};
    return {pair_in_words(first->evidence.told, second->evidence.told), passes_, pair_,
            std::min(first->end, second->end)};
  }

 private:
  std::optional<Finding> run(const Plan& plan, const WantedEvidence& wanted) {
    return trials_.run(plan, wanted, [] { return std::string("explaining: which events"); });
  }
  std::optional<Finding> log_of(const Plan& plan) { return run(plan, {.log_from = choice_.decision}); }
  std::optional<Finding> before(const Plan& plan, const EventOf& event) {
    std::optional<Finding> finding = run(plan, {.stop_before = event});
    if (finding && finding->evidence.told.empty()) finding.reset();
    return finding;
  }

  bool is_plainest() const { return pair_ && pair_->indirection == 0; }

  void consider(const Plan& plan, const Finding& finding) {
    if (!finding.passed()) return;
    const std::optional<EventPair> pair = pair_in_other_order(fails_, finding.evidence.log);
    if (passes_ && (!pair || (pair_ && pair_->indirection <= pair->indirection))) return;
    passes_ = plan;
    pair_ = pair;
  }

  Trials& trials_;
  const LeastFailure& least_;
  const LastChoice& choice_;
  std::vector<DoneEvent> fails_;  // of the failing run, after the choice
  std::optional<Plan> passes_;    // the passing run with the fewest differences
  std::optional<EventPair> pair_;
};

}  // namespace

ReversedEvents reversed_events(Trials& trials, const LeastFailure& least, const LastChoice& choice) {
  if (const char* const why = trials.traits().incomparable) return {why, choice.passing};
  return Comparison(trials, least, choice).found();
}

}  // namespace waitpoint::exploration
