// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "tools/command/interruption.hpp"

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

std::string result_line(std::uint64_t number, const Finding& finding) {
  return fmt::format("{:020} {} {}\n", number, digest_text(finding.digest),
                     finding.passed() ? "passed" : "failed: " + finding.headline());
}

bool Search::may_start(bool all) const {
  const ExploreOptions& options = target_.options();
  const std::uint64_t number = options.shard.index - 1 + started_ * options.shard.count;
  // Without noise the default order is a single schedule.
  const bool is_one = options.strategy == "fifo" && !target_.has_noise();
  return number < (is_one ? std::min<std::uint64_t>(options.iterations, 1) : options.iterations) && (all || !last_) &&
         !(options.time_limit_s > 0 && progress_.seconds() >= options.time_limit_s);
}

void Search::take(std::uint64_t number, Finding finding, bool all) {
  ++schedules_;
  if (finding.kind != Finding::Kind::killed) digests_.insert(finding.digest);
  if (all) lines_.emplace(number, result_line(number, finding));
  const bool goes_on = finding.passed() || goes_on_after(finding.kind, target_.options());
  if (!finding.passed()) ++failures_;
  if (goes_on && finding.kind == Finding::Kind::race) ++raced_;
  if (!goes_on && !all && (!last_ || number < *last_)) {
    last_ = number;
    target_.runs().kill_from(number);
  }
  const bool is_of_interest = !finding.passed() || !finding.racing.empty();
  waiting_.emplace(number, is_of_interest ? std::optional(std::move(finding)) : std::nullopt);
  discover(false);
}

// In the order of the numbers; after an interruption lower ones may be missing.
void Search::discover(bool at_end) {
  const Shard& shard = target_.options().shard;
  while (!waiting_.empty()) {
    const std::uint64_t number = waiting_.begin()->first;
    if (!at_end && number != shard.index - 1 + discovered_ * shard.count) return;
    std::optional<Finding> finding = std::move(waiting_.begin()->second);
    waiting_.erase(waiting_.begin());
    ++discovered_;
    if (!finding || (last_ && number > *last_)) continue;
    discoveries_.take({number, std::move(*finding)});
  }
}

void Search::run(bool all) {
  if (std::optional<DepthFirst> tree = DepthFirst::of(target_.options().strategy))
    run_depth_first(std::move(*tree), all);
  else
    run_drawn(all);
  discover(true);
  progress_.finish();
}

void Search::run_drawn(bool all) {
  const ExploreOptions& options = target_.options();
  while (!interrupted_) {
    while (target_.runs().count() < options.jobs && may_start(all)) {
      const std::uint64_t number = options.shard.index - 1 + started_++ * options.shard.count;
      target_.runs().start(number, Target::to_request({.number = number}, {}));
    }
    if (target_.runs().count() == 0) break;
    if (const auto ended = target_.runs().wait(look_around_ms)) take(ended->number, outcome_of(*ended), all);
    progress_.update(schedules_, distinct(), failures_);
    interrupted_ = interruption() != 0;
  }
  if (interrupted_) stop(target_);
  target_.runs().kill_from(0);
}

// Sequential: each schedule is derived from the one before.
void Search::run_depth_first(DepthFirst tree, bool all) {
  std::optional<std::vector<exploration::Deviation>> deviations{std::in_place};
  for (; deviations && may_start(all); ++started_) {
    std::optional<Finding> found = run_apart(target_, {.drawn = false, .deviations = *deviations}, {.choices = true});
    interrupted_ = !found;
    if (!found) return;
    deviations = tree.after(*found);
    take(started_, std::move(*found), all);
    progress_.update(schedules_, distinct(), failures_);
  }
  if (!deviations) scope_ = tree.scope();
}

}  // namespace waitpoint::tools
