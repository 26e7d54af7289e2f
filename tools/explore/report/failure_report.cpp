// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/report/failure_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/number_text.hpp"
#include "fibers/explore/schedules/token.hpp"
#include "tools/command/version.hpp"
#include "tools/explore/report/fewer_switches.hpp"
#include "tools/explore/report/finding_schedules.hpp"
#include "tools/explore/report/reversed_events.hpp"
#include "tools/explore/runs/switch_points.hpp"
#include "tools/explore/search/search.hpp"

namespace waitpoint::tools {
namespace {

using exploration::Token;
using exploration::token_digest;

constexpr std::uint64_t runs_to_minimize = 2000, runs_to_explain = 200;
constexpr double seconds_to_minimize = 90, seconds_to_explain = 60;
constexpr Duration traced = std::chrono::seconds(2);
constexpr const char* no_passing_sought = "--no-minimize: no passing run is sought";

// The trail of the run by this plan; empty for programs, runs from mid-run and killed runs.
exploration::Trail trail_of(Target& target, const Plan& plan, const Finding& finding) {
  exploration::Trail trail;
  const ExploreOptions& options = target.options();
  if (!options.program.empty() || options.from || finding.kind == Finding::Kind::killed) return trail;
  const auto told = run_apart(target, plan, {.trail = exploration::log_spacing_for(finding.events)});
  if (told && told->digest == finding.digest) (void)exploration::read_trail(told->trail, trail);
  return trail;
}

std::string headline(const std::string& which, const Finding& finding) {
  if (finding.kind == Finding::Kind::killed) return fmt::format("{} failed: {}\n", which, finding.words);
  return fmt::format("{} failed at {} s: {}\n", which, to_string(finding.end), finding.words);
}

/// The replay line, and what a page says beside the schedules.
void tell_replay(const Target& target, const Finding& least, const std::string& token, const std::string& schedule,
                 FailureReport& report) {
  const ExploreOptions options = with_switches_at(least.switch_at, target.options());
  const std::string command = replay_command(options, token);
  report.text += "replay: " + command + "\n";
  report.finding.title = target.name();
  report.finding.version = version_line();
  report.finding.seed = options.seed;
  report.finding.schedule = schedule;
  report.finding.failure = least.words;
  report.finding.replay = command;
  report.finding.debug = debug_command(options, token);
}

/// Empty if there is a pair.
std::string reason_without_pair(const ReversedEvents& reversed, bool is_noise, bool is_minimized) {
  if (reversed.pair) return "";
  if (is_noise) return "it is the noise, not the order: the passing run has the default order, and its own noise";
  if (!is_minimized) return no_passing_sought;
  if (!reversed.text.empty()) return reversed.text;
  return reversed.passing ? exploration::no_pair_in_words() : "no passing run was found in time";
}

/// Repeats the failing run to describe its switches and its last events.
void tell_run(Target& target, const Plan& plan, const Finding& least, FailureReport& report) {
  const Time from = Time() + std::max(Duration(), least.end.since_start() - traced);
  const auto told = run_apart(target, plan, {.words = true, .places = true, .events = true, .events_from = from});
  if (!told) return;
  report.text += told->details;
  report.races = told->races;
  if (!told->told.empty()) report.text += "switches away from the default order:\n" + told->told;
  report.finding.steps = told->last_events;
  if (!told->last_events.empty())
    report.text += "last events of the tasks (*: switch away from the default order):\n" + told->last_events;
  report.trace = told->trace;
}

/// The default order, which fails, beside a run that passes by deviating from it. A scenario would need the same noise.
void tell_default(Target& target, SearchProgress& progress, const Finding& failure, exploration::FindingFile& finding) {
  const ExploreOptions& options = target.options();
  ReversedEvents reversed;
  if (options.minimize && !target.has_noise() && failure.kind != Finding::Kind::killed) {
    Budget explaining(runs_to_explain, seconds_to_explain);
    const LeastFailure least{0, failure};
    if (const auto choice = last_choice(target, progress, explaining, least)) {
      finding.choice = choice->words;
      reversed = reversed_events(target, progress, explaining, least, *choice);
    }
  }
  finding.note = target.has_noise() ? "the default order fails, with the scenario's own noise"
                                    : reason_without_pair(reversed, false, options.minimize);
  add_schedules(target, {.drawn = false}, failure, reversed, finding);
  progress.finish();
}

}  // namespace

FailureReport report_default(Target& target, SearchProgress& progress, const Finding& finding) {
  FailureReport report;
  const ExploreOptions options = with_switches_at(finding.switch_at, target.options());
  report.text =
      headline(target.has_noise() ? "the default order, with the scenario's own noise," : "the default order", finding);
  report.schedule = {target.fingerprint(),
                     "fifo",
                     options.seed,
                     0,
                     Time() + options.from.value_or(Duration()),
                     finding.digest,
                     {},
                     trail_of(target, {.drawn = false}, finding)};
  tell_run(target, {.drawn = false}, finding, report);
  if (options.tells_finding()) tell_default(target, progress, finding, report.finding);
  if (finding.digest != 0) report.text += "digest: " + digest_text(finding.digest) + "\n";
  const Token token{0, token_digest(finding.digest), "", 0, 0, {}, {}, options.memory};
  tell_replay(target, finding, to_text_with(token, report.schedule.trail), "the default order", report);
  return report;
}

FailureReport report(Target& target, SearchProgress& progress, const FailedRun& failed) {
  const ExploreOptions options = with_switches_at(failed.finding.switch_at, target.options());
  FailureReport report;
  report.text = headline(name_of(failed, options) + ",", failed.finding);
  const Token found = token_of(failed, options);
  Plan plan = plan_of(failed, options);
  Token token = found;
  const Plan found_plan = plan;
  Finding least = failed.finding;
  ReversedEvents reversed;
  bool is_noise = false;
  if (options.minimize) {
    Budget budget(runs_to_minimize, seconds_to_minimize);
    FewerSwitches fewer(target, progress, budget, plan.number, failed.finding);
    fewer.run();
    is_noise = fewer.is_noise();
    if (is_noise) {
      report.text += target.has_noise() ? "it is the noise, not the order: with the noise of this schedule the default "
                                          "order fails too\n"
                                        : "the default order fails too, intermittently\n";
    } else if (fewer.repeats()) {
      const std::size_t count = fewer.least().switches.size();
      report.text += fmt::format("{} {} away from the default order {}, of {} that were found ({})\n", count,
                                 count == 1 ? "switch" : "switches", count == 1 ? "fails" : "fail",
                                 failed.finding.switches.size(), counted(budget.used(), "run"));
      if (target.has_noise() && fewer.number() == 0 && found_plan.number != 0)
        report.text += "the noise does not matter\n";
    }
    if (is_noise || fewer.repeats()) {
      least = fewer.least();
      plan = {.number = fewer.number(), .drawn = false, .switches = {}, .deviations = least.deviations};
      const Token deviating{0, token_digest(least.digest), "", 0, 0, least.deviations, {}, options.memory};
      if (fewer.number() == 0 && to_text(deviating).size() <= exploration::token_length_max) token = deviating;
    }
    Budget explaining(runs_to_explain, seconds_to_explain);
    const LeastFailure failure{plan.number, least};
    const bool is_usual = least.deviations.empty();
    if (const auto choice = is_usual ? std::nullopt : last_choice(target, progress, explaining, failure)) {
      report.finding.choice = choice->words;
      reversed = reversed_events(target, progress, explaining, failure, *choice);
      report.text += "the last choice from which it could still have passed: " + choice->words + "\n" + reversed.text;
    }
  }
  report.finding.note = reason_without_pair(reversed, is_noise, options.minimize);
  // The default order has passed with the target's own noise.
  if (is_noise && found_plan.number != 0) reversed.passing = Plan{.drawn = false};
  if (options.tells_finding()) add_schedules(target, plan, least, reversed, report.finding);
  progress.finish();
  report.schedule = {target.fingerprint(),
                     options.strategy,
                     options.seed,
                     plan.number,
                     Time() + options.from.value_or(Duration()),
                     least.digest,
                     least.switches,
                     trail_of(target, plan, least)};
  const exploration::Trail trail =
      token == found ? trail_of(target, found_plan, failed.finding) : report.schedule.trail;
  if (failed.finding.kind != Finding::Kind::killed) tell_run(target, plan, least, report);
  if (least.digest != 0) report.text += "digest: " + digest_text(least.digest) + "\n";
  tell_replay(target, least, to_text_with(token, trail), name_of(failed, options), report);
  if (options.schedule) report.text += "replay: " + replay_command(options, options.schedule->string()) + "\n";
  return report;
}

}  // namespace waitpoint::tools
