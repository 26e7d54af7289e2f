// SPDX-License-Identifier: BSD-3-Clause
// The search of a campaign: schedules that its strategy draws or enumerates, and the enumeration that follows draws
// which bring nothing new.
#include <chrono>

#include "fibers/explore/campaign.hpp"
#include "fibers/explore/races/races.hpp"
#include "fibers/explore/strategies/dpor.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "fibers/explore/strategies/fifo.hpp"

namespace waitpoint::exploration {

using Clock = std::chrono::steady_clock;

// `enumeration`: the exhaustive strategy that follows the campaign's own; null: that one.
bool Campaign::fails(Strategy& strategy, std::uint64_t number, const char* enumeration) {
  const std::string name = enumeration != nullptr ? enumeration : options_.strategy;
  supervisor_.begin(number, enumeration);
  strategy.begin(number, Draws(options_.seed, name, number), profile_);
  const Outcome outcome = body_.run(strategy);
  ++report_.schedules;
  if (outcome.was_cut)
    exhaustion_.take_cut();
  else if (enumeration != nullptr)
    exhaustion_.take_enumerated(outcome.trace);
  else
    exhaustion_.take_drawn(outcome.trace, body_.explorer().is_beyond_enumeration());
  if (outcome.passed()) return false;
  const Found found{
      .failure = {body_.explorer().schedule(), outcome},
      .token = {call_, token_digest(outcome.digest), name, options_.seed, number, {}, {}, options_.memory},
      .which =
          "schedule " + std::to_string(number) + " of strategy " + name + ", seed " + std::to_string(options_.seed),
      .enumeration = enumeration};
  if (goes_on_after(found)) return false;
  report_.failed_at = number;
  tell(found);
  return true;
}

// Events that race are not independent, whatever their objects.
void Campaign::begin_enumeration() {
  const bool is_first = !enumeration_;
  enumeration_.emplace(is_first && !first_race_ ? "dpor" : "dfs");
  enumeration_->strategy = make_strategy(enumeration_->name);
  races::note_unlearned(true);
}

// Runs its next schedule; false if the campaign is over.
bool Campaign::enumerate() {
  if (!enumeration_) begin_enumeration();
  Strategy& strategy = *enumeration_->strategy;
  if (fails(strategy, enumeration_->number++, enumeration_->name)) return false;
  if (strategy.end()) return true;
  if (exhaustion_.is_complete()) {
    set_scope(strategy, "exhausted, no other ordering exists");
    return false;
  }
  if (enumeration_->name == std::string_view("dfs"))
    enumeration_->is_over = true;
  else
    begin_enumeration();
  return true;
}

void Campaign::search() {
  const std::unique_ptr<Strategy> strategy = make_strategy(options_.strategy);
  const bool draws = !strategy->is_exhaustive() && options_.strategy != "fifo";
  const Clock::time_point start = Clock::now();
  races::note_unlearned(strategy->is_exhaustive());
  races::forget_left_out_values();
  std::uint64_t number = 0;
  for (std::uint64_t schedules = 0; schedules < options_.iterations; ++schedules) {
    if (options_.time_limit_s > 0 &&
        std::chrono::duration<double>(Clock::now() - start).count() >= options_.time_limit_s)
      break;
    if (draws && exhaustion_.is_next_enumerated() && !(enumeration_ && enumeration_->is_over)) {
      if (enumerate()) continue;
      if (!report_.text.empty()) return;
      break;
    }
    if (fails(*strategy, number++, nullptr)) return;
    if (!strategy->end()) {
      set_scope(*strategy, "all schedules");
      break;
    }
  }
  supervisor_.pause();
  Fifo usual;
  if (body_.run(usual).digest != usual_digest_) {
    report_.text = difference_to_the_first();
    if (report_.text.empty())
      report_.text =
          "the body leaks state from one schedule into the next: the default schedule differs from its first run";
  }
}

void Campaign::set_scope(const Strategy& strategy, const std::string& what) {
  const LeftOut& left_out = body_.explorer().left_out();
  std::string but;
  const auto add = [&](bool is_left_out, const char* what) {
    if (is_left_out) but += (but.empty() ? ", except " : " and ") + std::string(what);
  };
  add(left_out.turns, "turns of spinning tasks");
  add(left_out.costs, "computing costs between the bounds");
  add(left_out.spurious, "spurious wake-ups");
  add(races::noted_unlearned(), "switches at first accesses to memory that the default order does not share");
  add(races::left_out_values(), values_left_out);
  const bool is_up_to_equivalence = enumeration_ && enumeration_->name == std::string_view("dpor");
  report_.scope = what + (is_up_to_equivalence ? up_to_equivalence : strategy.scope()) + but;
  report_.complete = strategy.scope().empty() && !left_out.turns && !left_out.costs && !races::noted_unlearned() &&
                     !races::left_out_values();
}

}  // namespace waitpoint::exploration
