// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/run.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "fibers/kernel/fault_reports.hpp"
#include "fibers/sync/post_mortem.hpp"
#include "modules/run/expectation.hpp"
#include "modules/run/experiment.hpp"
#include "modules/run/journal.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tools/command/interruption.hpp"
#include "tools/command/program_layer.hpp"
#include "tools/output/output_file.hpp"
#include "tools/output/summary.hpp"
#include "tools/run/duration_files.hpp"
#include "tools/run/journal_file.hpp"
#include "tools/run/outputs.hpp"
#include "tools/run/prompt.hpp"
#include "tools/run/run_watchdog.hpp"
#include "tools/run/session.hpp"

namespace waitpoint::tools {
namespace {

bridge::RunResult result_of(const Session& session, std::uint64_t seed, bool interrupted) {
  bridge::RunResult result = session.result();
  result.seed = seed;
  if (interrupted && !session.over()) result.outcome = bridge::Outcome::interrupted;
  return result;
}

Session session_of(const RunOptions& options, run::Experiment& experiment, Outputs& outputs, Time until) {
  outputs.watch(experiment);
  return {experiment, until, options.speed,
          [&](std::int64_t second) { outputs.second(experiment.simulation(), second); }};
}

bridge::RunResult carry_out(const RunOptions& options, const scenario::Scenario& scenario, std::uint64_t seed,
                            run::Experiment& experiment, Outputs& outputs, JournalFile* journal) {
  Session session = session_of(options, experiment, outputs, options.limit(scenario.until));
  if (journal != nullptr) session.keep(*journal);
  bool interrupted = false;
  if (options.interactive)
    interrupted = !Prompt(session, STDIN_FILENO, isatty(STDIN_FILENO) != 0).run();
  else
    interrupted = session.carry_on(session.until()) == Session::Stop::interrupted;
  if (journal != nullptr) journal->write(run::to_text(session.here()));
  bridge::RunResult result = result_of(session, seed, interrupted);
  if (!interrupted && !session.over()) result.outcome = bridge::Outcome::left;
  return result;
}

// Replays a journal to its end; `same` tells if the run ended with the journal's event count and digest.
bridge::RunResult repeat(const RunOptions& options, const scenario::Scenario& scenario, const run::Journal& journal,
                         run::Experiment& experiment, Outputs& outputs, JournalFile* kept, bool& same) {
  const std::optional<run::JournalEnd> end = options.until ? std::nullopt : journal.end;
  // The run may have been left between two events of an instant: the number of events says where.
  const Time until = end ? end->time + Duration::from_ns(1) : options.limit(scenario.until);
  Session session = session_of(options, experiment, outputs, until);
  const kernel::Scheduler& scheduler = experiment.simulation().scheduler();
  Session::Stop stop = Session::Stop::target;
  if (!end)
    stop = session.carry_on(until);
  else if (end->events > 0)
    stop = session.carry_on(until, [seen = scheduler.events(), last = end->events](const kernel::EventRecord&) mutable {
      return ++seen == last;
    });
  const bool interrupted = stop == Session::Stop::interrupted;
  const run::JournalEnd here = session.here();
  same = interrupted || !end || (here.events == end->events && here.digest == end->digest);
  if (kept != nullptr) kept->write(run::to_text(here));
  bridge::RunResult result = result_of(session, options.seed, interrupted);
  if (end && !interrupted && result.outcome == bridge::Outcome::time_limit) {
    result.simulated = end->time.since_start();
    if (end->time < options.limit(scenario.until)) result.outcome = bridge::Outcome::left;
  }
  return result;
}

int status(const scenario::Scenario& scenario, const bridge::RunResult& result) {
  if (result.outcome == bridge::Outcome::interrupted) return 130;
  const std::vector<std::string> unmet = run::unmet(scenario.expect, result);
  std::fflush(stdout);
  for (const std::string& line : unmet) std::fprintf(stderr, "waitpoint: not as expected: %s\n", line.c_str());
  return unmet.empty() ? 0 : 1;
}

void tell_of(const run::Journal& journal, bool same) {
  if (!journal.end) std::fputs("waitpoint: the journal has no end: the run that wrote it did not finish\n", stderr);
  if (same) return;
  std::fprintf(stderr, "waitpoint: this is not the run of the journal, which ended with %s after %llu events\n",
               journal.end->digest.c_str(), static_cast<unsigned long long>(journal.end->events));
}

int run_seeds(const RunOptions& options, const scenario::Scenario& scenario, std::span<const genom::ModuleType> types) {
  std::optional<OutputFile> summary;
  if (options.summary) summary.emplace(*options.summary);
  std::vector<bridge::RunResult> results;
  int worst = 0;
  std::fputs(seeds_head().c_str(), stdout);
  for (std::uint64_t seed = options.seeds->first; interruption() == 0; ++seed) {
    run::Experiment experiment(scenario, types, {seed, options.order, replay_line(options, seed)});
    RunOptions single = options;
    single.summary.reset();
    Outputs none(single, scenario);
    results.push_back(carry_out(options, scenario, seed, experiment, none, nullptr));
    std::fputs(seeds_row(results.back()).c_str(), stdout);
    std::fflush(stdout);
    worst = std::max(worst, status(scenario, results.back()));
    if (seed == options.seeds->last) break;
  }
  if (summary) {
    summary->write(summary_json(results));
    summary->commit();
  }
  flush_standard_output();
  return interruption() != 0 ? 130 : worst;
}

}  // namespace

int run(const RunOptions& options, std::span<const genom::ModuleType> types) {
  const scenario::Scenario scenario = scenario::read_scenario(options.scenario, options.assignments);
  begin_with_program_layer(scenario);
  heed_signals();
  kernel::set_post_mortem(sync::write_call_stack);
  const RunWatchdog watchdog(options.watchdog_s);
  if (options.seeds) return run_seeds(options, scenario, types);
  run::Experiment experiment(scenario, types, {options.seed, options.order, replay_line(options, options.seed)});
  const run::JournalHead head = run::journal_head(scenario, options.seed, options.order);
  std::string lines = to_text(head);
  std::optional<run::Journal> journal;
  if (options.replay_journal) {
    journal = run::read_journal(*options.replay_journal, head);
    for (const auto& [date, intervention] : journal->interventions)
      lines += to_text(experiment.intervene(intervention, date), intervention);
  }
  Outputs outputs(options, scenario);
  DurationFiles durations(options, scenario, experiment);
  std::optional<JournalFile> kept;
  if (options.journal) kept.emplace(*options.journal).write(lines);
  JournalFile* const keep = kept ? &*kept : nullptr;
  bool same = true;
  const bridge::RunResult result = journal ? repeat(options, scenario, *journal, experiment, outputs, keep, same)
                                           : carry_out(options, scenario, options.seed, experiment, outputs, keep);
  durations.finish(result.outcome == bridge::Outcome::finished);
  std::fputs(summary_text(result).c_str(), options.summary == "-" ? stderr : stdout);
  std::fflush(stdout);
  outputs.write(experiment, result);
  flush_standard_output();
  if (journal) tell_of(*journal, same);
  return same ? status(scenario, result) : 1;
}

}  // namespace waitpoint::tools
