// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/body.hpp"

#include <sstream>

#include "fibers/explore/races/races.hpp"
#include "fibers/explore/strategies/fifo.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"

namespace waitpoint::exploration {
namespace {

SimulationOptions explored() {
  SimulationOptions options;
  options.order = kernel::Order::explored;
  return options;
}

std::string describe_races(sync::Places places) {
  if (places == sync::Places::left_out) return "a data race";
  std::ostringstream text;
  const std::vector<races::Race> found = races::found();
  text << (found.size() == 1 ? "a data race" : std::to_string(found.size()) + " data races");
  for (const races::Race& race : found) text << "\n" << race;
  return text.str();
}

}  // namespace

Body::Body(std::function<void()> function, ExternalChecks* checks, Time until, std::uint32_t steps_max, Memory memory)
    : function_(std::move(function)),
      checks_(checks),
      until_(until),
      simulation_(explored()),
      reports_(&simulation_.scheduler()),
      explorer_(simulation_.scheduler(), steps_max, memory),
      memory_(memory) {
  simulation_.scheduler().set_decisions(explorer_);
  tell(sync::Places::left_out);
}

Body::~Body() { races::set_weak_memory(false); }

void Body::tell(sync::Places places) {
  places_ = places;
  simulation_.tell(places);
}

void Body::start(Strategy& strategy, const Played& played) {
  races::set_weak_memory(memory_ == Memory::weak);
  if (used_) simulation_.restart(0);
  used_ = true;
  explorer_.begin(strategy, played);
  sync::forget_started();
  if (checks_ != nullptr) checks_->begin();
  simulation_.spawn(simulation_.environment(), {.name = "main"}, function_);
}

Outcome Body::run(Strategy& strategy, const Played& played) {
  start(strategy, played);
  Outcome outcome;
  bool ended_by_checks = false;
  try {
    outcome.end = simulation_.run_before(until_);
  } catch (...) {  // reported by trouble()
    ended_by_checks = checks_ != nullptr && checks_->is_own(std::current_exception());
  }
  outcome.failure = simulation_.trouble();
  outcome.was_cut = explorer_.was_cut();
  if (!outcome.was_cut && outcome.failure.empty() && outcome.end == RunEnd::time_reached)
    outcome.failure = "not finished at " + to_string(until_) + " s of virtual time";
  if (outcome.failure.empty() && sync::has_started_outside_of_virtual_time())
    outcome.failure = sync::started_outside_of_virtual_time;
  outcome.digest = simulation_.digest().value();
  outcome.trace = explorer_.trace();
  outcome.end_time = simulation_.global_time();
  outcome.events = simulation_.scheduler().events();
  simulation_.unwind();
  outcome.abandoned = simulation_.abandoned();
  if (checks_ != nullptr)
    if (std::string failures = checks_->end(); !failures.empty())
      outcome.failure = outcome.failure.empty() || ended_by_checks ? failures : failures + "\n" + outcome.failure;
  outcome.only_raced = fails_on_races_ && outcome.failure.empty() && races::any_found();
  if (outcome.only_raced) outcome.failure = describe_races(places_);
  return outcome;
}

void Body::run_up_to(const Played& played, const std::function<void()>& look) {
  Fifo rest;
  start(rest, played);
  try {
    simulation_.scheduler().run_before(until_);
    look();
  } catch (...) {
    simulation_.unwind();
    throw;
  }
  simulation_.unwind();
  if (checks_ != nullptr) (void)checks_->end();
}

void Body::run_watched_by(kernel::Decisions& decisions, const Schedule& schedule) {
  Fifo rest;
  simulation_.scheduler().set_decisions(decisions);
  (void)run(rest, {.prefix = schedule.decisions});
  simulation_.scheduler().set_decisions(explorer_);
}

}  // namespace waitpoint::exploration
