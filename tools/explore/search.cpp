// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search.hpp"

#include <fmt/format.h>

#include "tools/interruption.hpp"

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

}  // namespace

std::optional<Finding> run_apart(Target& target, const Plan& plan, const Target::Request& request) {
  Children children;
  children.start(0, [&] { return to_bytes(target.run(plan, request)); });
  while (interruption() == 0)
    if (const auto ended = children.wait(look_around_ms)) return outcome_of(*ended);
  return std::nullopt;
}

std::string result_line(std::uint64_t number, const Finding& finding) {
  return fmt::format("{:020} {} {}\n", number, digest_text(finding.digest),
                     finding.passed() ? "passed" : "failed: " + finding.headline());
}

bool Search::may_start(bool all) const {
  const ExploreOptions& options = target_.options();
  const std::uint64_t number = options.shard.index - 1 + started_ * options.shard.count;
  return number < options.iterations && (all || !first_) &&
         !(options.time_limit_s > 0 && progress_.seconds() >= options.time_limit_s);
}

void Search::take(const Children::Ended& ended, bool all) {
  Finding finding = outcome_of(ended);
  ++schedules_;
  if (finding.kind != Finding::Kind::killed) digests_.insert(finding.digest);
  if (all) lines_.emplace(ended.number, result_line(ended.number, finding));
  if (finding.passed()) return;
  ++failures_;
  if (first_ && first_->number < ended.number) return;
  if (!all) children_.kill_from(ended.number);
  first_ = Failed{ended.number, std::move(finding)};
}

void Search::run(bool all) {
  const ExploreOptions& options = target_.options();
  while (!interrupted_) {
    while (children_.count() < options.jobs && may_start(all)) {
      const std::uint64_t number = options.shard.index - 1 + started_++ * options.shard.count;
      children_.start(number, [&] { return to_bytes(target_.run({.number = number})); });
    }
    if (children_.count() == 0) break;
    if (const auto ended = children_.wait(look_around_ms)) take(*ended, all);
    progress_.update(schedules_, distinct(), failures_);
    interrupted_ = interruption() != 0;
  }
  children_.kill_from(0);
  progress_.finish();
}

}  // namespace waitpoint::tools
