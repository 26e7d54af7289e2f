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

// A scenario's run never blocks; a program's is a separate process, for which the child waits.
Children::Limits limits_of(const Target& target) {
  return {.wall_s = target.limit_s(), .computes = target.options().program.empty()};
}

// A program's run that has gone on for long says what its threads do.
void stop(Children& children, const Target& target) {
  if (target.options().program.empty()) return;
  if (const auto ended = children.stop_longest())
    if (const std::string words = outcome_of(*ended).words; !words.empty())
      std::fprintf(stderr, "waitpoint: %s\n", words.c_str());
}

}  // namespace

Search::Search(Target& target, SearchProgress& progress)
    : target_(target), progress_(progress), children_(limits_of(target)) {}

std::optional<Finding> run_apart(Target& target, const Plan& plan, const Target::Request& request) {
  Children children(limits_of(target));
  children.start(0, [&] { return to_bytes(target.run(plan, request)); });
  while (interruption() == 0)
    if (const auto ended = children.wait(look_around_ms)) return outcome_of(*ended);
  stop(children, target);
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
  return number < (is_one ? std::min<std::uint64_t>(options.iterations, 1) : options.iterations) && (all || !first_) &&
         !(options.time_limit_s > 0 && progress_.seconds() >= options.time_limit_s);
}

void Search::take(std::uint64_t number, Finding finding, bool all) {
  ++schedules_;
  if (finding.kind != Finding::Kind::killed) digests_.insert(finding.digest);
  if (all) lines_.emplace(number, result_line(number, finding));
  if (finding.passed()) return;
  ++failures_;
  if (first_ && first_->number < number) return;
  if (!all) children_.kill_from(number);
  first_ = Failed{number, std::move(finding)};
}

void Search::run(bool all) {
  if (std::optional<DepthFirst> tree = DepthFirst::of(target_.options().strategy))
    run_depth_first(std::move(*tree), all);
  else
    run_drawn(all);
  progress_.finish();
}

void Search::run_drawn(bool all) {
  const ExploreOptions& options = target_.options();
  while (!interrupted_) {
    while (children_.count() < options.jobs && may_start(all)) {
      const std::uint64_t number = options.shard.index - 1 + started_++ * options.shard.count;
      children_.start(number, [&] { return to_bytes(target_.run({.number = number})); });
    }
    if (children_.count() == 0) break;
    if (const auto ended = children_.wait(look_around_ms)) take(ended->number, outcome_of(*ended), all);
    progress_.update(schedules_, distinct(), failures_);
    interrupted_ = interruption() != 0;
  }
  if (interrupted_) stop(children_, target_);
  children_.kill_from(0);
}

// Sequential: each schedule is derived from the one before.
void Search::run_depth_first(DepthFirst tree, bool all) {
  std::optional<std::vector<exploration::Deviation>> deviations{std::in_place};
  for (; deviations && may_start(all); ++started_) {
    std::optional<Finding> found = run_apart(target_, {.drawn = false, .deviations = *deviations}, {.choices = true});
    interrupted_ = !found;
    if (!found) return;
    deviations = tree.after(found->choices);
    take(started_, std::move(*found), all);
    progress_.update(schedules_, distinct(), failures_);
  }
  if (!deviations) scope_ = tree.scope();
}

}  // namespace waitpoint::tools
