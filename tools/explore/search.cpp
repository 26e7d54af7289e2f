// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "fibers/explore/strategies/dfs.hpp"
#include "fibers/explore/strategies/dpor.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "tools/command/interruption.hpp"
#include "tools/explore/depth_first.hpp"
#include "tools/explore/partial_order.hpp"

namespace waitpoint::tools {
namespace {

constexpr int look_around_ms = 100;

Finding outcome_of(const Children::Ended& ended) {
  const std::string death = death_of(ended);
  if (death.empty()) return finding_of(std::string_view(ended.bytes));
  Finding finding;
  finding.kind = Finding::Kind::killed;
  finding.words = death;
  return finding;
}

// For the name of a strategy; null if that is not exhaustive.
std::unique_ptr<Exhaustive> make_exhaustive(const std::string& name) {
  const auto strategy = exploration::make_strategy(name);
  if (const auto* const dfs = dynamic_cast<const exploration::Dfs*>(strategy.get()))
    return std::make_unique<DepthFirst>(dfs->preemptions(), dfs->scope());
  if (dynamic_cast<const exploration::Dpor*>(strategy.get()) != nullptr) return std::make_unique<PartialOrder>();
  return nullptr;
}

// A program's run that has gone on for long says what its threads do.
void stop(Target& target) {
  if (target.options().program.empty()) return;
  if (const auto ended = target.runs().stop_longest())
    if (const std::string words = outcome_of(*ended).words; !words.empty())
      std::fprintf(stderr, "waitpoint: %s\n", words.c_str());
}

}  // namespace

std::optional<Finding> run_apart(Target& target, const Plan& plan, const Target::Request& request) {
  target.runs().start(0, Target::to_request(plan, request));
  while (interruption() == 0)
    if (const auto ended = target.runs().wait(look_around_ms)) return outcome_of(*ended);
  stop(target);
  target.runs().kill_from(0);
  return std::nullopt;
}

bool Search::may_start() const {
  const ExploreOptions& options = target_.options();
  const std::uint64_t number = options.shard.index - 1 + started_ * options.shard.count;
  // Without noise the default order is a single schedule.
  const bool is_one = options.strategy == "fifo" && !target_.has_noise();
  return number < (is_one ? std::min<std::uint64_t>(options.iterations, 1) : options.iterations) && !last_ &&
         !(options.time_limit_s > 0 && progress_.seconds() >= options.time_limit_s);
}

void Search::take(std::uint64_t number, Finding finding) {
  ++schedules_;
  if (finding.kind != Finding::Kind::killed && !finding.was_cut) digests_.insert(finding.digest);
  const bool goes_on = finding.passed() || goes_on_after(finding.kind, target_.options());
  if (!finding.passed()) ++failures_;
  if (goes_on && finding.kind == Finding::Kind::race) ++raced_;
  if (!goes_on && results_ == nullptr && (!last_ || number < *last_)) {
    last_ = number;
    target_.runs().kill_from(number);
  }
  waiting_.emplace(number, std::move(finding));
  report(false);
}

// In the order of the numbers; after an interruption lower ones may be missing.
void Search::report(bool at_end) {
  const Shard& shard = target_.options().shard;
  while (!waiting_.empty()) {
    const std::uint64_t number = waiting_.begin()->first;
    if (!at_end && number != shard.index - 1 + reported_ * shard.count) return;
    Finding finding = std::move(waiting_.begin()->second);
    waiting_.erase(waiting_.begin());
    ++reported_;
    if (results_ != nullptr) results_->take(number, finding);
    if (finding.passed() && finding.racing.empty()) continue;
    if (!last_ || number <= *last_) discoveries_.take({number, std::move(finding)});
  }
}

void Search::run() {
  if (results_ != nullptr) results_->begin(target_);
  if (const std::unique_ptr<Exhaustive> schedules = make_exhaustive(target_.options().strategy))
    run_exhaustively(*schedules);
  else
    run_drawn();
  report(true);
  progress_.finish();
}

void Search::run_drawn() {
  const ExploreOptions& options = target_.options();
  while (!interrupted_) {
    while (target_.runs().count() < options.jobs && may_start()) {
      const std::uint64_t number = options.shard.index - 1 + started_++ * options.shard.count;
      target_.runs().start(number, Target::to_request({.number = number}, {}));
    }
    if (target_.runs().count() == 0) break;
    if (const auto ended = target_.runs().wait(look_around_ms)) take(ended->number, outcome_of(*ended));
    progress_.update(schedules_, distinct(), failures_);
    interrupted_ = interruption() != 0;
  }
  if (interrupted_) stop(target_);
  target_.runs().kill_from(0);
}

// Sequential: each schedule is derived from the one before.
void Search::run_exhaustively(Exhaustive& schedules) {
  std::optional<Plan> plan = schedules.first();
  for (; plan && may_start(); ++started_) {
    std::optional<Finding> found = run_apart(target_, *plan, {.choices = true});
    interrupted_ = !found;
    if (!found) return;
    plan = schedules.after(*found);
    take(started_, std::move(*found));
    progress_.update(schedules_, distinct(), failures_);
  }
  if (!plan) scope_ = schedules.scope();
}

}  // namespace waitpoint::tools
