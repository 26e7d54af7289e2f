// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/run.hpp"

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <system_error>

#include "core/number_text.hpp"
#include "fibers/kernel/process_end.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/unfinished_run.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"
#include "modules/run/experiment.hpp"
#include "modules/run/journal.hpp"
#include "modules/run/ranks/dividable.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tools/command/interruption.hpp"
#include "tools/command/program_layer.hpp"
#include "tools/command/system_confinement.hpp"
#include "tools/nodes/bag_play.hpp"
#include "tools/nodes/seed_with_nodes.hpp"
#include "tools/nodes/simulated_nodes.hpp"
#include "tools/nodes/world_partner.hpp"
#include "tools/output/json_document.hpp"
#include "tools/output/summary.hpp"
#include "tools/ranks/joined_ranks.hpp"
#include "tools/ranks/launcher.hpp"
#include "tools/run/duration_files.hpp"
#include "tools/run/journal_file.hpp"
#include "tools/run/log_run.hpp"
#include "tools/run/outputs.hpp"
#include "tools/run/prompt.hpp"
#include "tools/run/reports.hpp"
#include "tools/run/run_json.hpp"
#include "tools/run/run_watchdog.hpp"
#include "tools/run/seed_runs.hpp"
#include "tools/run/session.hpp"
#include "tools/run/tcl_shell.hpp"
#include "tools/run/viewed_run.hpp"

namespace waitpoint::tools {
namespace {

bridge::RunResult result_of(const Session& session, std::uint64_t seed, bool interrupted) {
  bridge::RunResult result = session.result();
  result.seed = seed;
  if (is_among_nodes()) {  // where the wall clock shows virtual time
    result.wall_s = result.real_time_factor = 0;
    result.lag.reset();
  }
  if (interrupted && !session.over()) result.outcome = bridge::Outcome::interrupted;
  return result;
}

Session session_of(const RunOptions& options, run::Experiment& experiment, Outputs& outputs, Time until) {
  outputs.watch();
  // Among nodes the wall clock is virtual time, too.
  return {experiment, until, is_among_nodes() ? 1 : options.speed,
          [&](std::int64_t second) { outputs.second(second); }};
}

bridge::RunResult carry_out(const RunOptions& options, const scenario::Scenario& scenario, std::uint64_t seed,
                            run::Experiment& experiment, Outputs& outputs, outside::Partners& partners,
                            view::LiveRun* live) {
  Session session = session_of(options, experiment, outputs, options.limit(scenario.until));
  JournalFile* const journal = outputs.journal();
  if (journal != nullptr) session.keep(*journal);
  if (live != nullptr) session.show(*live);
  if (!partners.empty()) session.take_part(partners, options.partners.faults_end);
  bool interrupted = false;
  if (options.tcl)
    interrupted = !TclShell(session, STDIN_FILENO, isatty(STDIN_FILENO) != 0).run();
  else if (options.interactive)
    interrupted = !Prompt(session, STDIN_FILENO, isatty(STDIN_FILENO) != 0).run();
  else
    interrupted = session.carry_on(session.until()) == Session::Stop::interrupted;
  if (journal != nullptr) journal->write(run::to_text(session.here()));
  bridge::RunResult result = result_of(session, seed, interrupted);
  if (!interrupted && (!session.over() || !session.fault().empty() || session.is_finished()))
    result.outcome = bridge::Outcome::left;
  return result;
}

// Replays a journal to its end; `same` tells if the run ended with the journal's event count and digest.
bridge::RunResult repeat(const RunOptions& options, const scenario::Scenario& scenario, const run::Journal& journal,
                         run::Experiment& experiment, Outputs& outputs, view::LiveRun* live, bool& same) {
  const std::optional<run::JournalEnd> end = options.until ? std::nullopt : journal.end;
  // The run may have been left between two events of an instant: the number of events says where.
  const Time until = end ? end->time + Duration::from_ns(1) : options.limit(scenario.until);
  Session session = session_of(options, experiment, outputs, until);
  if (live != nullptr) session.show(*live);
  const kernel::Scheduler& scheduler = experiment.simulation().scheduler();
  Session::Stop stop = Session::Stop::target;
  if (!end)
    stop = session.carry_on(until);
  else if (experiment.ranks() > 1)
    stop = session.carry_on(end->time);
  else if (end->events > 0)
    stop = session.carry_on(until, [seen = kernel::events(scheduler),
                                    last = end->events](const kernel::EventRecord&) mutable { return ++seen == last; });
  const bool interrupted = stop == Session::Stop::interrupted;
  const run::JournalEnd here = session.here();
  same = interrupted || !end || (here.events == end->events && here.digest == end->digest);
  if (outputs.journal() != nullptr) outputs.journal()->write(run::to_text(here));
  bridge::RunResult result = result_of(session, options.seed, interrupted);
  if (end && !interrupted && result.outcome == bridge::Outcome::time_limit) {
    result.simulated = end->time.since_start();
    if (end->time < options.limit(scenario.until)) result.outcome = bridge::Outcome::left;
  }
  return result;
}

// Before the run, which may end like that of the journal.
void tell_of_cut(const run::Journal& journal) {
  if (!journal.cut_off.empty())
    std::fprintf(stderr, "waitpoint: the journal has no end: its run was cut off: %s\n", journal.cut_off.c_str());
  else if (!journal.end)
    std::fputs("waitpoint: the journal has no end: the run that wrote it did not finish\n", stderr);
}

void tell_of_difference(const run::Journal& journal) {
  std::fprintf(stderr, "waitpoint: this is not the run of the journal, which ended with %s after %s\n",
               journal.end->digest.c_str(), counted(journal.end->events, "event").c_str());
}

/// One run of a series; its row is in the table.
bridge::RunResult run_seed(const RunOptions& options, const scenario::Scenario& scenario,
                           std::span<const genom::ModuleType> types, std::uint64_t seed, const std::string& replay) {
  run::Experiment experiment(scenario, types, {seed, options.order, replay});
  confine_to_listed_files();
  RunOptions single = options;
  single.summary.reset();
  Outputs none(single, scenario, experiment);
  outside::Partners nobody;
  return carry_out(options, scenario, seed, experiment, none, nobody, nullptr);
}

int run_once(const RunOptions& options, const scenario::Scenario& scenario, run::Experiment& experiment,
             view::Channel* viewer, std::optional<Outputs>& outputs) {
  const run::JournalHead head = run::journal_head(scenario, options.seed, options.order);
  std::string lines = to_text(head);
  std::optional<run::Journal> journal;
  if (options.replay_journal) {
    journal = run::read_journal(*options.replay_journal, head);
    tell_of_cut(*journal);
    for (const auto& [date, intervention] : journal->interventions)
      lines += to_text(experiment.intervene(intervention, date), intervention);
  }
  outside::Partners partners = make_partners(options.partners, scenario);
  std::shared_ptr<nodes::ShownTopics> shown_topics;
  if (is_among_nodes() && !journal) {
    shown_topics = std::make_shared<nodes::ShownTopics>();
    partners.add(make_world_partner(scenario, shown_topics, options.is_brief));
  }
  sync::tell_threads_outside();
  outputs.emplace(options, scenario, experiment);
  confine_to_listed_files();
  outputs->show(shown_topics);
  if (outputs->journal() != nullptr) outputs->journal()->write(lines);
  std::optional<view::LiveRun> live;
  if (viewer != nullptr) live.emplace(*viewer, scenario, experiment, scene_options(options, scenario), lines);
  view::LiveRun* const shown = live ? &*live : nullptr;
  bool same = true;
  bridge::RunResult result = journal
                                 ? repeat(options, scenario, *journal, experiment, *outputs, shown, same)
                                 : carry_out(options, scenario, options.seed, experiment, *outputs, partners, shown);
  if (options.idle > Duration() && result.outcome != bridge::Outcome::deadlock)
    result.idle = experiment.idle(options.idle);
  outputs->check(result);
  const kernel::Commit commit;
  Printed printed(options);
  printed.print(summary_text(result));
  outputs->write(result);
  if (is_among_nodes()) leave_result(result);
  if (live) live->finish(result);
  printed.check();
  if (!same) tell_of_difference(*journal);
  const Verdict ended = same ? verdict(scenario, result) : Verdict{1, {}};
  if (!options.json) return ended.status;
  return end_with_json("run", ended.status, run_json(result, ended.unmet, replay_line(options, options.seed)));
}

// May begin this process anew, with a library for the scenario's programs.
scenario::Scenario scenario_of(const RunOptions& options) {
  scenario::Scenario scenario = scenario::read_scenario(options.scenario, options.assignments, options.allowed);
  if (is_rank() && scenario.has_nodes()) throw BadInput("--ranks", "cannot be used for a scenario with nodes");
  if (is_rank()) run::check_dividable(scenario);
  begin_with_program_layer(scenario);
  return scenario;
}

// A run with nodes is several processes in one virtual time, which begin together.
void check_for_nodes(const RunOptions& options) {
  constexpr const char* others[] = {
      "--speed",    "--serve",      "--interactive", "--tcl", "--verify", "--record-durations", "--replay-durations",
      "--external", "--serve-world"};
  check_none_given(options, others, "cannot be used for a scenario with nodes");
}

// Without a world there is nothing to write but the nodes' results.
void check_for_bag(const RunOptions& options) {
  constexpr const char* of_worlds[] = {"--json",    "--strategy", "--journal", "--replay-journal",
                                       "--summary", "--picture",  "--page",    "--trajectory",
                                       "--record",  "--digests",  "--events",  "--decisions"};
  check_none_given(options, of_worlds, "cannot be used where a bag is played in the place of a world");
}

int run_bag(const RunOptions& options, const scenario::Scenario& scenario) {
  if (is_among_nodes()) return play_bag(scenario, options.seed, options.limit(scenario.until));
  check_for_nodes(options);
  check_for_bag(options);
  check_bag_play(scenario);
  return run_among_nodes(options.arguments, options.seed);
}

// In one process, or as the leader of several.
int run_alone(const RunOptions& options, const scenario::Scenario& scenario, std::span<const genom::ModuleType> types,
              run::Ranks* ranks, view::Channel* viewer) {
  const std::string replay = replay_line(options, options.seed);
  const kernel::UnfinishedRun unfinished(replay.c_str());
  std::optional<run::Experiment> experiment;
  std::optional<Outputs> outputs;
  try {
    experiment.emplace(scenario, types, run::ExperimentOptions{options.seed, options.order, replay, ranks});
    for (const auto& robot : experiment->robots())
      if (const std::string text = robot->plan_text(); !text.empty())
        std::fprintf(stderr, "waitpoint: %s\n", text.c_str());
    return run_once(options, scenario, *experiment, viewer, outputs);
  } catch (const BadInput&) {
    throw;
  } catch (const std::system_error&) {
    throw;  // no memory or process for the run: another attempt may succeed
  } catch (const std::exception& failure) {
    return report_failure(failure, replay, outputs ? &*outputs : nullptr);
  }
}

// On a rank that does not lead: its failures are reported by the leader, which gets them.
int follow(const RunOptions& options, const scenario::Scenario& scenario, std::span<const genom::ModuleType> types,
           run::Ranks& ranks) {
  const std::string replay = replay_line(options, options.seed);
  const kernel::UnfinishedRun unfinished(replay.c_str());
  try {
    run::Experiment experiment(scenario, types, {options.seed, options.order, replay, &ranks});
    const RankOutputs outputs(scenario, experiment,
                              {.events = options.events.has_value(),
                               .paths = options.trajectory.has_value(),
                               .picture = options.picture.has_value(),
                               .record = options.record.has_value()});
    experiment.follow();
  } catch (const LeaderLost& lost) {
    return report_failure(lost, replay, nullptr);
  } catch (const std::exception&) {
  }
  return 0;
}

// One of several processes. The leader reports bad input of any of them.
int run_rank(const RunOptions& options, std::span<const genom::ModuleType> types) {
  std::optional<scenario::Scenario> scenario;
  std::exception_ptr bad;
  try {
    scenario = scenario_of(options);
  } catch (const BadInput&) {
    bad = std::current_exception();
  }
  heed_signals();
  const RunWatchdog watchdog(options.watchdog_s);
  const std::unique_ptr<run::Transport> transport = join_ranks(options.ranks);
  const RankProcesses processes(*transport);
  tell_launcher_of_leader();
  run::Ranks ranks(*transport, watch_over(*transport, processes, options.watchdog_s * 6));
  try {
    ranks.act_together([&] {
      if (bad != nullptr) std::rethrow_exception(bad);
      ranks.place(run::Placement(*scenario, ranks.rank(), ranks.count()));
    });
    ranks.check_same("build", options.build);
    ranks.check_same("scenario", to_string(Digest(scenario->fingerprint)));
    ranks.check_same("seed", std::to_string(options.seed));
  } catch (const BadInput&) {
    if (ranks.leads()) throw;
    return 0;
  }
  return ranks.leads() ? run_alone(options, *scenario, types, &ranks, nullptr)
                       : follow(options, *scenario, types, ranks);
}

}  // namespace

int run(const RunOptions& options, std::span<const genom::ModuleType> types) {
  if (is_rank() && !options.seeds) return run_rank(options, types);
  if (options.ranks > 1) {
    check_for_ranks();
    return run_ranks(options.ranks, options.arguments);
  }
  const scenario::Scenario scenario = scenario_of(options);
  heed_signals();
  if (options.is_brief && !scenario.has_nodes()) throw BadInput("--brief", "expected a scenario with nodes");
  if (scenario.play) return run_bag(options, scenario);
  if (scenario.has_nodes() && !is_among_nodes() && !options.replay_journal) {
    check_nodes(scenario);
    check_for_nodes(options);
    if (!options.seeds) return run_among_nodes(options.arguments, options.seed);
    return run_seeds(options, scenario, [&](std::uint64_t seed, const std::string&) {
      return run_seed_with_nodes(options.arguments, seed);
    });
  }
  if (scenario.log) {
    const RunWatchdog watchdog(options.watchdog_s);
    return run_log(options, scenario, types);
  }
  const auto run_here = [&](view::Channel* viewer) {
    const RunWatchdog watchdog(options.watchdog_s);
    return run_alone(options, scenario, types, nullptr, viewer);
  };
  if (options.serve) check_can_be_viewed(scenario);
  if (options.serve) return run_viewed(options, scenario, [&](view::Channel& viewer) { return run_here(&viewer); });
  if (!options.seeds) return run_here(nullptr);
  const RunWatchdog watchdog(options.watchdog_s);
  return run_seeds(options, scenario, [&](std::uint64_t seed, const std::string& replay) {
    return run_seed(options, scenario, types, seed, replay);
  });
}

}  // namespace waitpoint::tools
