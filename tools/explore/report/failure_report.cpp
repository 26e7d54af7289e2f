// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/report/failure_report.hpp"

#include <fmt/format.h>

#include "core/program_path.hpp"
#include "fibers/explore/analysis/analysis.hpp"
#include "fibers/explore/report/reordered_events.hpp"
#include "fibers/explore/schedules/token.hpp"
#include "tools/command/version.hpp"
#include "tools/explore/report/variable_fields.hpp"
#include "tools/explore/runs/replay_command.hpp"
#include "tools/explore/runs/switch_points.hpp"

namespace waitpoint::tools {
namespace {

using exploration::Analysis;
using exploration::Token;

// The trail of the run by this plan; empty for programs, runs from mid-run and killed runs.
exploration::Trail trail_of(ProcessTarget& target, const Plan& plan, const exploration::Finding& finding) {
  exploration::Trail trail;
  const ExploreOptions& options = target.options();
  if (!options.program.empty() || options.from || finding.kind == RunVerdict::Kind::killed) return trail;
  const auto told = target.repeat(plan, {.trail = exploration::log_spacing_for(finding.events)});
  if (told && told->digest == finding.digest) (void)exploration::read_trail(told->evidence.trail, trail);
  return trail;
}

std::string headline(const std::string& which, const Finding& finding) {
  if (finding.kind == RunVerdict::Kind::killed) return fmt::format("{} failed: {}\n", which, finding.words);
  return fmt::format("{} failed at {} s: {}\n", which, to_string(finding.end), finding.words);
}

/// The failure is analysed, and its report begun, up to what the analysis says.
Analysis analysed(ProcessTarget& target, SearchProgress& progress, const Plan& plan, const Finding& found,
                  const std::string& which, FailureReport& report) {
  const ExploreOptions& options = target.options();
  Analysis analysis =
      analyse(target, &progress, plan, found,
              {.minimize = options.minimize, .page = options.tells_finding(), .trace = options.trace.has_value()});
  progress.finish();
  report.text = headline(which, found) + analysis.text;
  if (found.switch_at == SwitchAt::calls && analysis.finding.note == exploration::no_pair_in_words())
    report.text += "accesses to memory are no events here: --switch-at accesses searches their orders, too\n";
  if (analysis.least.digest != 0) report.text += "digest: " + digest_text(analysis.least.digest) + "\n";
  report.races = std::move(analysis.races);
  report.trace = std::move(analysis.trace);
  report.graver = analysis.graver;
  report.finding = std::move(analysis.finding);
  report.schedule = {target.fingerprint(),
                     options.strategy,
                     options.seed,
                     analysis.plan.number,
                     Time() + options.from.value_or(Duration()),
                     analysis.least.digest,
                     analysis.least.switches,
                     trail_of(target, analysis.plan, analysis.least)};
  return analysis;
}

/// The replay line, and what a page says beside the schedules.
void tell_replay(const ProcessTarget& target, const ExploreOptions& options, const std::string& words,
                 const std::string& token, const std::string& schedule, FailureReport& report) {
  const std::string command = replay_command(options, token);
  report.text += "replay: " + command + "\n";
  if (!options.program.empty())
    report.text = with_fields(std::move(report.text), find_program(options.program.front()));
  report.finding.title = target.name();
  report.finding.version = version_line();
  report.finding.seed = options.seed;
  report.finding.schedule = schedule;
  report.finding.failure = words;
  report.finding.replay = command;
  report.finding.debug = debug_command(options, token);
}

}  // namespace

FailureReport report_default(ProcessTarget& target, SearchProgress& progress, const Finding& finding) {
  FailureReport report;
  const ExploreOptions options = with_switches_at(finding.switch_at, target.options());
  const std::string which =
      target.traits().has_noise ? "the default order, with the scenario's own noise," : "the default order";
  (void)analysed(target, progress, {.drawn = false}, finding, which, report);
  report.schedule.strategy = "fifo";
  const Token token = exploration::token_by_deviations(finding, options);
  tell_replay(target, options, finding.words, to_text_with(token, report.schedule.trail), "the default order", report);
  return report;
}

FailureReport report(ProcessTarget& target, SearchProgress& progress, const exploration::FailedRun& failed) {
  const ExploreOptions options = with_switches_at(failed.finding.switch_at, target.options());
  FailureReport report;
  const std::string which = exploration::name_of(failed, options);
  const Plan found = plan_of(failed, options);
  const Analysis analysis = analysed(target, progress, found, failed.finding, which + ",", report);
  const exploration::Finding& least = analysis.least;
  const Token as_found = token_of(failed, options);
  Token token = as_found;
  if (analysis.is_minimized && analysis.plan.number == 0) {
    const Token deviating = exploration::token_by_deviations(least, options);
    if (to_text(deviating).size() <= exploration::token_length_max) token = deviating;
  }
  const exploration::Trail trail = token == as_found ? trail_of(target, found, failed.finding) : report.schedule.trail;
  tell_replay(target, options, least.words, to_text_with(token, trail), which, report);
  if (options.schedule) report.text += "replay: " + replay_command(options, options.schedule->string()) + "\n";
  return report;
}

}  // namespace waitpoint::tools
