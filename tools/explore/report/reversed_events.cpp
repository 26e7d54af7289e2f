// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/report/reversed_events.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/explore/search/search.hpp"

namespace waitpoint::tools {
namespace {

using exploration::DoneEvent;
using exploration::EventPair;

// Limit of alternatives tried: the durations of a computation are many and much alike.
constexpr std::uint32_t alternatives_max = 8;

// In the first process they are the world's, which is right.
constexpr const char* not_among_nodes =
    "the two events whose order matters are not looked for in the processes of nodes\n";

class Comparison {
 public:
  Comparison(Target& target, SearchProgress& progress, Budget& budget, const LeastFailure& least,
             const LastChoice& choice)
      : target_(target), progress_(progress), budget_(budget), least_(least), choice_(choice) {}

  ReversedEvents found() {
    const std::optional<Finding> failing = log_of(least_.plan());
    if (!failing) return {};
    fails_ = failing->log;
    for (std::uint32_t other = 0; other < alternatives_max && !is_plainest(); ++other) {
      const std::optional<Finding> tried = log_of(least_.plan_up_to(choice_.decision, other));
      if (!tried || tried->parted) break;  // no further alternatives
      consider(least_.plan_up_to(choice_.decision, other), *tried);
    }
    if (!passes_)
      if (const std::optional<Finding> tried = log_of(choice_.passing)) consider(choice_.passing, *tried);
    if (!passes_) return {};
    if (!pair_) return {exploration::no_pair_in_words(), passes_};
    const std::optional<Finding> first = before(least_.plan(), pair_->failing),
                                 second = before(*passes_, pair_->passing);
    if (!first || !second) return {"", passes_};
    return {exploration::pair_in_words(first->told, second->told), passes_, pair_, std::min(first->end, second->end)};
  }

 private:
  std::optional<Finding> run(const Plan& plan, const Target::Request& request) {
    if (!budget_.take()) return std::nullopt;
    progress_.update(fmt::format("explaining: which events, run {}", budget_.used()));
    return run_apart(target_, plan, request);
  }
  std::optional<Finding> log_of(const Plan& plan) { return run(plan, {.log_from = choice_.decision}); }
  std::optional<Finding> before(const Plan& plan, const exploration::EventOf& event) {
    std::optional<Finding> finding = run(plan, {.stop_before = event});
    if (finding && finding->told.empty()) finding.reset();
    return finding;
  }

  bool is_plainest() const { return pair_ && pair_->indirection == 0; }

  void consider(const Plan& plan, const Finding& finding) {
    if (!finding.passed()) return;
    const std::optional<EventPair> pair = exploration::pair_in_other_order(fails_, finding.log);
    if (passes_ && (!pair || (pair_ && pair_->indirection <= pair->indirection))) return;
    passes_ = plan;
    pair_ = pair;
  }

  Target& target_;
  SearchProgress& progress_;
  Budget& budget_;
  const LeastFailure& least_;
  const LastChoice& choice_;
  std::vector<DoneEvent> fails_;  // of the failing run, after the choice
  std::optional<Plan> passes_;    // the passing run with the fewest differences
  std::optional<EventPair> pair_;
};

}  // namespace

ReversedEvents reversed_events(Target& target, SearchProgress& progress, Budget& budget, const LeastFailure& least,
                               const LastChoice& choice) {
  if (target.options().has_nodes) return {not_among_nodes, choice.passing};
  return Comparison(target, progress, budget, least, choice).found();
}

}  // namespace waitpoint::tools
