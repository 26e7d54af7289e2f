// SPDX-License-Identifier: BSD-3-Clause
// The search of a campaign: schedules that its strategy draws or enumerates, and the enumeration that follows draws
// which bring nothing new.
#include <chrono>

#include "fibers/explore/campaign.hpp"
#include "fibers/explore/races/races.hpp"
#include "fibers/explore/search/failures.hpp"
#include "fibers/explore/search/omissions.hpp"
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
  const RunVerdict verdict = body_.run(strategy);
  ++report_.schedules;
  if (verdict.was_cut)
    exhaustion_.take_cut();
  else if (enumeration != nullptr)
    exhaustion_.take_enumerated(verdict.order);
  else
    exhaustion_.take_drawn(verdict.order, verdict.is_beyond_enumeration);
  if (verdict.passed()) return false;
  Found found = last_run(verdict);
  found.token = {call_, token_digest(verdict.digest), name, options_.seed, number, {}, {}, options_.memory};
  found.which = name_of_schedule(number, name, options_.seed);
  found.enumeration = enumeration;
  if (goes_on_after(found)) return false;
  report_.failed_at = number;
  tell(found);
  return true;
}

void Campaign::begin_enumeration() {
  enumeration_.emplace(exhaustion_.strategy());
  enumeration_->strategy = make_strategy(enumeration_->name);
  races::note_unlearned(true);
}

// Runs its next schedule; false if the campaign is over.
bool Campaign::enumerate() {
  if (!enumeration_) {
    if (first_race_) exhaustion_.keep_equivalent();
    begin_enumeration();
  }
  Strategy& strategy = *enumeration_->strategy;
  if (fails(strategy, enumeration_->number++, enumeration_->name)) return false;
  if (strategy.end()) return true;
  if (exhaustion_.end_enumeration()) {
    set_scope(strategy, "exhausted, no other ordering exists");
    return false;
  }
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
    if (draws && exhaustion_.is_next_enumerated()) {
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
  Omissions omissions{body_.explorer().left_out(), races::noted_unlearned(), races::left_out_values()};
  const bool is_up_to_equivalence = enumeration_ && enumeration_->name == std::string_view("dpor");
  report_.scope = what + (is_up_to_equivalence ? up_to_equivalence : strategy.scope()) + omissions.in_words();
  omissions.spurious = false;
  report_.complete = strategy.scope().empty() && !omissions.any();
}

}  // namespace waitpoint::exploration
