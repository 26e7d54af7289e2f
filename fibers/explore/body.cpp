// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/body.hpp"

#include <algorithm>
#include <sstream>

#include "core/error.hpp"
#include "fibers/explore/races/races.hpp"
#include "fibers/explore/schedules/course.hpp"
#include "fibers/explore/strategies/fifo.hpp"
#include "fibers/explore/target/evidence_recorder.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
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
  kernel::set_decisions(simulation_.scheduler(), explorer_);
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

RunVerdict Body::run(Strategy& strategy, const Played& played) { return carry_out(strategy, played, until_, nullptr); }

RunVerdict Body::carry_out(Strategy& strategy, const Played& played, Time until, EvidenceRecorder* recording) {
  start(strategy, played);
  RunVerdict verdict;
  RunEnd end = RunEnd::ended;
  bool ended_by_checks = false;
  try {
    end = simulation_.run_before(until);
  } catch (...) {  // reported by trouble()
    ended_by_checks = checks_ != nullptr && checks_->is_own(std::current_exception());
  }
  verdict.was_cut = explorer_.was_cut();
  const bool has_stopped = recording != nullptr && recording->has_stopped();
  judge(end, until, verdict.was_cut || has_stopped || until < until_, verdict);
  verdict.digest = simulation_.digest().value();
  verdict.order = explorer_.trace();
  verdict.end = simulation_.global_time();
  verdict.events = kernel::events(simulation_.scheduler());
  verdict.is_beyond_enumeration = explorer_.is_beyond_enumeration();
  verdict.cuts_polls_short = explorer_.schedule().cuts_polls_short;
  verdict.has_unlearned_code = races::noted_unlearned();
  verdict.has_left_out_values = races::left_out_values();
  verdict.has_raced = races::any_found();
  if (recording != nullptr) recording->finish();
  simulation_.unwind();
  if (checks_ != nullptr)
    if (std::string failures = checks_->end(); !failures.empty()) {
      failure_ = failure_.empty() || ended_by_checks ? failures : failures + "\n" + failure_;
    }
  if (!failure_.empty() && verdict.passed()) verdict.kind = RunVerdict::Kind::unmet;
  if (fails_on_races_ && failure_.empty() && verdict.has_raced) {
    verdict.kind = RunVerdict::Kind::race;
    failure_ = describe_races(places_);
  }
  return verdict;
}

void Body::judge(RunEnd end, Time until, bool may_end_early, RunVerdict& verdict) {
  failure_ = simulation_.trouble();
  if (!failure_.empty())
    verdict.kind = end == RunEnd::deadlock      ? RunVerdict::Kind::deadlock
                   : end == RunEnd::no_progress ? RunVerdict::Kind::no_progress
                                                : RunVerdict::Kind::unmet;
  else if (end == RunEnd::time_reached && !may_end_early)
    failure_ = "not finished at " + to_string(until) + " s of virtual time";
  if (failure_.empty() && sync::has_started_outside_of_virtual_time()) failure_ = sync::started_outside_of_virtual_time;
}

Finding Body::finding_of(const RunVerdict& verdict) const {
  Finding finding;
  static_cast<RunVerdict&>(finding) = verdict;
  finding.words = failure_;
  finding.take(explorer_.schedule(), explorer_.parted());
  finding.lesson.choices = explorer_.schedule().decisions;
  return finding;
}

Finding Body::repeat(const Plan& plan, const WantedEvidence& wanted) {
  WAITPOINT_CHECK(!plan.drawn, "a body's schedule is to be repeated by its draws");
  tell(wanted.places ? sync::Places::told : sync::Places::left_out);
  const std::unique_ptr<Strategy> strategy =
      begin_course({.number = plan.attempt, .at_random_from = plan.at_random_from}, explorer_, {});
  Finding finding;
  {
    EvidenceRecorder recording(wanted, simulation_, explorer_, finding);
    const RunVerdict verdict = carry_out(*strategy, {.switches = plan.switches, .deviations = plan.deviations},
                                         std::min(until_, plan.until), &recording);
    static_cast<RunVerdict&>(finding) = verdict;
  }
  tell(sync::Places::left_out);
  finding.words = failure_;
  finding.take(explorer_.schedule(), explorer_.parted());
  if (wanted.choices) finding.lesson.choices = explorer_.schedule().decisions;
  if (wanted.places && races::any_found())
    for (const races::Race& race : races::found()) finding.evidence.races.push_back(told(race));
  return finding;
}

void Body::run_up_to(const Played& played, const std::function<void()>& look) {
  Fifo rest;
  start(rest, played);
  try {
    kernel::run_before(simulation_.scheduler(), until_);
    look();
  } catch (...) {
    simulation_.unwind();
    throw;
  }
  simulation_.unwind();
  if (checks_ != nullptr) (void)checks_->end();
}

}  // namespace waitpoint::exploration
