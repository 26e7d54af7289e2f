// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/search/search.hpp"

#include <algorithm>
#include <utility>

#include "fibers/explore/strategies/factory.hpp"

namespace waitpoint::exploration {
namespace {

// In place of a place, of a schedule of another shard, which is run for what is learned from it: together with its
// number.
constexpr std::uint64_t of_another_shard = std::uint64_t{1} << 63;

}  // namespace

Search::Search(const ExploreOptions& options, SearchExtent extent, const TimeLimit& time_limit, Runner& runner,
               Discoveries& discoveries, ProgressListener* progress)
    : options_(options),
      extent_(std::move(extent)),
      time_limit_(time_limit),
      runner_(runner),
      discoveries_(discoveries),
      progress_(progress),
      reports_races_(options.races == Races::report),
      is_exhaustive_(make_strategy(options.strategy)->is_exhaustive()) {
  if (is_exhaustive_)
    enumeration_.emplace(options.strategy);
  else if (extent_.learns)
    feedback_.emplace(options.strategy, options.seed);
  if (extent_.has_sample && !is_exhaustive_) sample_.emplace(options.strategy);
}

void Search::count_default(const RunVerdict& verdict) {
  ++schedules_;
  exhaustion_.take_drawn(verdict.order, false);
}

bool Search::may_start() const {
  return extent_.first + started_ * extent_.step < extent_.iterations && !failure_place_ && !is_exhausted_ &&
         !time_limit_.is_over();
}

// How the next schedule comes about; nothing while that depends on one that still runs. What follows from the results
// of draws is decided at every `decided_after` schedules, from those up to as many before: so it does not depend on how
// many run at once, and none is waited for unless it takes long.
std::optional<Search::Origin> Search::next_origin() const {
  if (is_exhaustive_) return counted_ == started_ ? std::optional(Origin::enumerated) : std::nullopt;
  if (!extent_.may_be_exhausted) return Origin::drawn;
  const std::uint64_t interval = extent_.decided_after;
  const std::uint64_t decided = interval == 0 ? started_ : started_ / interval * interval;
  const std::uint64_t needed = decided - std::min(decided, interval);
  if (counted_ < needed) return std::nullopt;
  if (!begun_after_ || *begun_after_ > needed) return Origin::drawn;
  if (counted_ < started_) return std::nullopt;
  return exhaustion_.is_next_enumerated() ? Origin::enumerated : Origin::drawn;
}

// False if none can be started for now.
bool Search::start_next() {
  if ((failure_place_ || !time_limit_.is_over()) && runner_.start_rest(failure_place_.value_or(of_another_shard)))
    return true;
  const std::optional<Origin> origin = may_start() ? next_origin() : std::nullopt;
  if (origin == Origin::enumerated) start_enumerated();
  return origin == Origin::enumerated || (origin == Origin::drawn && start_drawn());
}

// As many at once as a batch has, up to one that may come about otherwise, or learns.
bool Search::start_drawn() {
  if (learns(next_drawn())) return start_learning();
  Batch batch{.place = started_, .number = next_drawn(), .count = 0};
  const std::uint32_t most = runner_.capacity();
  do {
    open_.push_back({.number = next_drawn()});
    ++started_;
    ++drawn_;
    ++batch.count;
  } while (batch.count < most && may_start() && next_origin() == Origin::drawn && !learns(next_drawn()));
  runner_.start(batch);
  return true;
}

// False if it depends on one that still runs, or must wait for its turn.
bool Search::start_learning() {
  const std::uint64_t number = next_drawn();
  Constraints constraints;
  while (feedback_->next() <= number) {
    if (runner_.capacity() == 0) return false;
    std::optional<Plan> next = feedback_->plan_of_next();
    if (!next) return false;
    if (next->number == number)
      constraints = std::move(next->constraints);
    else  // of another shard
      runner_.start({.place = of_another_shard | next->number, .number = next->number, .learned = &next->constraints});
  }
  ++drawn_;
  open_.push_back({.number = number, .constraints = std::move(constraints)});
  runner_.start({.place = started_++, .number = number, .learned = &open_.back().constraints});
  return true;
}

// Events that race are not independent.
void Search::begin_enumeration() {
  if (has_races_) exhaustion_.keep_equivalent();
  enumeration_.emplace(Enumeration::after_draws(exhaustion_.strategy()));
}

void Search::start_enumerated() {
  if (!enumeration_) begin_enumeration();
  open_.push_back(
      {.number = enumeration_->number(), .is_enumerated = true, .enumeration = enumeration_->after_draws()});
  runner_.start(started_++, *enumeration_);
}

void Search::take(EndedSchedule& ended) {
  if ((ended.place & of_another_shard) != 0) return feedback_->take(ended.place & ~of_another_shard, *ended.finding);
  Open& open = open_[ended.place - counted_];
  const RunVerdict::Kind kind = ended.verdict.kind;
  const bool goes_on = ended.verdict.passed() || goes_on_after(kind, reports_races_) || extent_.each;
  if (!goes_on && (!failure_place_ || ended.place < *failure_place_)) {
    failure_place_ = ended.place;
    runner_.kill_from(ended.place);
  }
  if (open.is_enumerated) {
    if (!enumeration_->take(ended.verdict, ended.choices, runner_.is_apart() ? ended.finding.get() : nullptr)) {
      exhaustion_.keep_equivalent();
      begin_enumeration();
    }
  } else if (learns(open.number)) {
    feedback_->take(open.number, *ended.finding);
  }
  const bool was_last = open.is_enumerated && enumeration_->is_over();
  if (ended.place != counted_) {
    open.ended = std::make_unique<EndedSchedule>(std::move(ended));
    return;
  }
  count_first(&ended);
  while (!open_.empty() && open_.front().ended) count_first(open_.front().ended.get());
  if (was_last) end_enumeration();
}

// All of its schedules have been tried, and no other runs.
void Search::end_enumeration() {
  const std::optional<std::string> scope = enumeration_->scope();
  is_exhausted_ = is_exhaustive_ || exhaustion_.end_enumeration(scope.has_value());
  if (is_exhausted_) {
    scope_ = scope;
    unproved_ = enumeration_->unproved();
  } else {
    begin_enumeration();
  }
}

void Search::count(Open& open, EndedSchedule& ended) {
  const RunVerdict& verdict = ended.verdict;
  ++schedules_;
  if (verdict.was_cut)
    exhaustion_.take_cut();
  else if (open.is_enumerated)
    exhaustion_.take_enumerated(verdict.order);
  else if (verdict.kind != RunVerdict::Kind::killed)
    exhaustion_.take_drawn(verdict.order, verdict.is_beyond_enumeration);
  if (sample_ && !open.is_enumerated && verdict.kind != RunVerdict::Kind::killed && sample_->contains(open.number))
    sample_->take(ended.pairs, verdict.switch_at);
  has_races_ |= verdict.has_raced;
  if (obstacle_ == AccessObstacle::none) obstacle_ = verdict.obstacle;
  generated_code_ = std::max(generated_code_, verdict.generated_code);
  libraries_ |= verdict.libraries;
  failures_ += !verdict.passed();
  raced_ += verdict.kind == RunVerdict::Kind::race && reports_races_;
  if (ended.finding == nullptr) return;
  if (extent_.each) extent_.each(open.number, *ended.finding);
  if (!verdict.passed() || verdict.has_raced)
    discoveries_.take({open.number, std::move(*ended.finding), std::move(open.constraints), open.enumeration});
}

// In the order of their places, up to the failure that ends the search: how many more had been begun depends on the
// machine. Null: it is missing.
void Search::count_first(EndedSchedule* ended) {
  if (ended != nullptr && (!failure_place_ || counted_ <= *failure_place_)) count(open_.front(), *ended);
  open_.pop_front();
  ++counted_;
  if (!begun_after_ && exhaustion_.has_begun()) begun_after_ = counted_;
}

void Search::run() {
  while (!runner_.is_interrupted()) {
    while (runner_.capacity() > 0 && start_next()) {
    }
    if (runner_.is_idle()) break;
    if (EndedSchedule* const ended = runner_.next_ended()) take(*ended);
    if (progress_ != nullptr) progress_->update(schedules_, distinct(), failures_);
  }
  runner_.kill_from(0);
  while (!open_.empty()) count_first(open_.front().ended.get());
}

}  // namespace waitpoint::exploration
