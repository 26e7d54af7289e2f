// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/search.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "tools/command/interruption.hpp"

namespace waitpoint::tools {
namespace {

// What follows from the results of schedules is decided at every so many, from those up to as many before: so it does
// not depend on how many run at once, and none is waited for unless it takes long.
constexpr std::uint64_t decision_interval = 64;

// In place of a place, of a schedule of another shard, which is run for what is learned from it: together with its
// number.
constexpr std::uint64_t of_another_shard = std::uint64_t{1} << 63;

}  // namespace

Search::Search(ProcessTarget& target, SearchProgress& progress, Discoveries& discoveries, ResultsFile* results)
    : target_(target),
      progress_(progress),
      discoveries_(discoveries),
      results_(results),
      batches_(target.batch_max()),
      reports_races_(target.options().races == Races::report) {
  const ExploreOptions& options = target.options();
  enumeration_ = Enumeration::of_options(options.strategy);
  is_exhaustive_ = enumeration_.has_value();
  // A scenario has too many schedules; a shard does not know those of others; results are of as many as asked for.
  if (!is_exhaustive_ && !options.program.empty()) feedback_.emplace(options.strategy, options.seed);
  may_be_exhausted_ = !is_exhaustive_ && !options.program.empty() && options.strategy != "fifo" &&
                      options.shard.count == 1 && results == nullptr;
}

bool Search::may_start() const {
  const ExploreOptions& options = target_.options();
  const std::uint64_t number = options.shard.index - 1 + started_ * options.shard.count;
  // Without noise the default order is a single schedule.
  const bool is_one = options.strategy == "fifo" && !target_.traits().has_noise;
  return number < (is_one ? std::min<std::uint64_t>(options.iterations, 1) : options.iterations) && !failure_place_ &&
         !is_exhausted_ && has_time();
}

bool Search::has_time() const {
  const double limit_s = target_.options().time_limit_s;
  return limit_s <= 0 || progress_.seconds() < limit_s;
}

// Tells `exhaustion_` of the first `count` schedules.
void Search::tell_exhaustion(std::uint64_t count) {
  for (; told_ < count; ++told_) {
    const Ended& ended = ended_[told_];
    if (ended.is_lost) continue;
    if (!ended.is_enumerated)
      exhaustion_.take_drawn(ended.order, ended.is_beyond);
    else if (ended.was_cut)
      exhaustion_.take_cut();
    else
      exhaustion_.take_enumerated(ended.order);
  }
}

// How the next schedule comes about; nothing while that depends on one that still runs.
std::optional<Search::Origin> Search::next_origin() {
  if (is_exhaustive_) return ended_.size() == started_ ? std::optional(Origin::enumerated) : std::nullopt;
  if (!may_be_exhausted_) return Origin::drawn;
  if (!exhaustion_.has_begun()) {
    const std::uint64_t known = started_ / decision_interval * decision_interval;
    const std::uint64_t needed = known - std::min(known, decision_interval);
    if (ended_.size() < needed) return std::nullopt;
    tell_exhaustion(needed);
    if (!exhaustion_.has_begun()) return Origin::drawn;
  }
  if (ended_.size() < started_) return std::nullopt;
  tell_exhaustion(started_);
  if (!exhaustion_.is_next_enumerated()) return Origin::drawn;
  if (!enumeration_) {
    if (has_races_) exhaustion_.keep_equivalent();
    enumeration_ = Enumeration::after_draws(exhaustion_.strategy());
  }
  return Origin::enumerated;
}

// False if none can be started for now.
bool Search::start_next() {
  if (start_left()) return true;
  const std::optional<Origin> origin = may_start() ? next_origin() : std::nullopt;
  if (origin == Origin::enumerated) start_enumerated();
  return origin == Origin::enumerated || (origin == Origin::drawn && start_drawn());
}

// The rest of a batch; it is of drawn schedules. Those of earlier places than the failure that ends the search are run
// at any rate.
bool Search::start_left() {
  if (!failure_place_ && !has_time()) return false;
  const std::optional<Batches::Batch> left = batches_.take_left(failure_place_.value_or(of_another_shard));
  if (left) start(*left, {.number = *running_.at(left->place).number}, {});
  return left.has_value();
}

std::uint64_t Search::next_drawn() const {
  const Shard& shard = target_.options().shard;
  return shard.index - 1 + drawn_ * shard.count;
}

bool Search::learns(std::uint64_t number) const { return feedback_ && feedback_->is_learned(number); }

// As many at once as a batch has, up to one that may come about otherwise, or learns.
bool Search::start_drawn() {
  if (learns(next_drawn())) return start_learning();
  Batches::Batch batch{started_, 0};
  const std::uint64_t first = next_drawn();
  do {
    running_[started_++] = {.number = next_drawn(), .finding = {}};
    ++drawn_;
    ++batch.count;
  } while (batch.count < batches_.size() && may_start() && next_origin() == Origin::drawn && !learns(next_drawn()));
  start(batch, {.number = first}, {});
  return true;
}

// False if it depends on one that still runs, or must wait for its turn.
bool Search::start_learning() {
  const std::uint64_t number = next_drawn();
  Plan plan{.number = number};
  while (feedback_->next() <= number) {
    if (target_.runs().count() == target_.options().jobs) return false;
    const std::optional<Plan> next = feedback_->plan_of_next();
    if (!next) return false;
    if (next->number == number)
      plan = *next;
    else  // of another shard
      target_.runs().start(of_another_shard | next->number, ProcessTarget::to_request(*next, {.pairs = true}));
  }
  ++drawn_;
  running_[started_] = {.number = number, .finding = {}, .constraints = plan.constraints};
  start({started_++, 1}, plan, {.pairs = true});
  return true;
}

void Search::start_enumerated() {
  enumerating_ = started_;
  running_[started_] = {.number = enumeration_->number(), .finding = {}, .enumeration = enumeration_->name()};
  start({started_++, 1}, *enumeration_->next(), {.choices = true});
}

// `plan` is of the first.
void Search::start(const Batches::Batch& batch, const Plan& plan, const WantedEvidence& wanted) {
  batches_.start(batch, progress_.seconds());
  const ProcessTarget::Repeats repeats{.step = target_.options().shard.count, .count = batch.count - 1};
  target_.runs().start(batch.place, ProcessTarget::to_request(plan, wanted, repeats));
}

void Search::take_ended(const Children::Ended& ended) {
  std::vector<ProcessFinding> findings = ProcessTarget::findings_of(ended);
  if ((ended.number & of_another_shard) != 0)
    return feedback_->take(ended.number & ~of_another_shard, findings.front());
  if (!death_of(ended).empty() && batches_.divide(ended.number)) return;
  batches_.end(ended.number, static_cast<std::uint32_t>(findings.size()), progress_.seconds());
  std::uint64_t place = ended.number;
  for (ProcessFinding& finding : findings) take(place++, std::move(finding));
}

void Search::take(std::uint64_t place, ProcessFinding finding) {
  const bool goes_on = finding.passed() || goes_on_after(finding.kind, reports_races_);
  if (!goes_on && results_ == nullptr && (!failure_place_ || place < *failure_place_)) {
    failure_place_ = place;
    target_.runs().kill_from(place);
  }
  const bool is_enumerated = enumerating_ == place;
  if (is_enumerated && !enumeration_->take(finding)) {
    exhaustion_.keep_equivalent();
    enumeration_ = Enumeration::after_draws(exhaustion_.strategy());
  }
  FailedRun run = std::move(running_.extract(place).mapped());
  if (!is_enumerated && learns(*run.number)) feedback_->take(*run.number, finding);
  run.finding = std::move(finding);
  waiting_.emplace(place, std::move(run));
  report(false);
  if (is_enumerated && !enumeration_->next()) end_enumeration();
}

// All of its schedules have been tried, and no other runs.
void Search::end_enumeration() {
  tell_exhaustion(ended_.size());
  const std::optional<std::string> scope = enumeration_->scope();
  is_exhausted_ = is_exhaustive_ || exhaustion_.end_enumeration(scope.has_value());
  if (is_exhausted_) {
    scope_ = scope;
    unproved_ = enumeration_->unproved();
  } else {
    enumeration_ = Enumeration::after_draws(exhaustion_.strategy());
  }
}

// Of schedules up to the failure that ends the search: how many more had been begun depends on the machine.
void Search::count(const ProcessFinding& finding) {
  ++schedules_;
  if (finding.kind != ProcessFinding::Kind::killed && !finding.was_cut) orders_.insert(finding.order);
  if (finding.passed()) return;
  ++failures_;
  raced_ += finding.kind == ProcessFinding::Kind::race && reports_races_;
}

// In the order of their places; after an interruption earlier ones may be missing.
void Search::report(bool at_end) {
  while (!waiting_.empty()) {
    const std::uint64_t place = waiting_.begin()->first;
    if (!at_end && place != ended_.size()) return;
    FailedRun run = std::move(waiting_.begin()->second);
    waiting_.erase(waiting_.begin());
    const ProcessFinding& finding = run.finding;
    ended_.push_back({.order = finding.order,
                      .is_enumerated = enumerating_ == place,
                      .is_lost = finding.kind == ProcessFinding::Kind::killed,
                      .was_cut = finding.was_cut,
                      .is_beyond = finding.is_beyond_enumeration});
    if (!failure_place_ || place <= *failure_place_) count(finding);
    has_races_ = has_races_ || !finding.racing.empty();
    if (obstacle_ == posix::AccessObstacle::none) obstacle_ = finding.obstacle;
    if (results_ != nullptr) results_->take(*run.number, finding);
    if (finding.passed() && finding.racing.empty()) continue;
    if (!failure_place_ || place <= *failure_place_) discoveries_.take(std::move(run));
  }
}

void Search::run() {
  const ExploreOptions& options = target_.options();
  if (results_ != nullptr) results_->begin(target_);
  while (!interrupted_) {
    while (target_.runs().count() < options.jobs && start_next()) {
    }
    if (target_.runs().count() == 0) break;
    if (const auto ended = target_.runs().wait(ProcessTarget::look_around_ms)) take_ended(*ended);
    progress_.update(schedules_, distinct(), failures_);
    interrupted_ = interruption() != 0;
  }
  interrupted_ ? target_.stop_runs() : target_.runs().kill_from(0);
  report(true);
  progress_.finish();
}

}  // namespace waitpoint::tools
