// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <optional>

#include "modules/bridge/expectation.hpp"
#include "modules/bridge/experiment.hpp"
#include "modules/bridge/scenario_reader.hpp"
#include "tools/duration_files.hpp"
#include "tools/output_file.hpp"
#include "tools/pacing.hpp"
#include "tools/picture.hpp"
#include "tools/progress.hpp"
#include "tools/recorders.hpp"
#include "tools/summary.hpp"
#include "tools/trajectory.hpp"

namespace waitpoint::tools {
namespace {

constexpr Duration window = std::chrono::milliseconds(100);
constexpr std::int64_t windows_per_second = 10;

volatile std::sig_atomic_t interrupted = 0;

void interrupt(int) { interrupted = 1; }

// The first signal ends the run in good order; a second one, or one outside a run, does what it does by default.
void heed_signals() {
  struct sigaction action {};
  action.sa_handler = interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

// The files of one run: opened before it starts, written when it is over.
class Outputs {
 public:
  Outputs(const RunOptions& options, const bridge::Scenario& scenario) {
    if (options.summary) summary_.emplace(*options.summary);
    if (options.picture) picture_.emplace(*options.picture);
    if (options.digests) digests_.emplace(*options.digests);
    if (options.events) events_.emplace(*options.events);
    if (!options.trajectory) return;
    std::vector<std::string> names;
    for (const bridge::RobotScenario& robot : scenario.robots) names.push_back(robot.name);
    trajectory_.emplace(*options.trajectory, names);
  }

  void watch(Simulation& simulation) {
    if (events_) events_->watch(simulation);
  }
  void second(const Simulation& simulation, std::int64_t second) {
    if (digests_) digests_->record(simulation, second);
  }
  void write(bridge::Experiment& experiment, const bridge::RunResult& result) {
    if (summary_) {
      summary_->write(summary_json(result));
      summary_->commit();
    }
    if (picture_) {
      picture_->write(picture_svg(experiment.world().description().obstacles, result));
      picture_->commit();
    }
    if (trajectory_) trajectory_->write(result);
    if (digests_) digests_->finish();
    if (events_) events_->finish();
  }

 private:
  std::optional<OutputFile> summary_, picture_;
  std::optional<TrajectoryFiles> trajectory_;
  std::optional<DigestRecorder> digests_;
  std::optional<EventRecorder> events_;
};

void flush_stdout() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw BadInput("standard output", "cannot be written");
}

std::string replay_line(const RunOptions& options, std::uint64_t seed) {
  std::string line = "waitpoint run " + options.scenario.string() + " --seed " + std::to_string(seed);
  if (options.order == kernel::Order::seeded) line += " --order seeded";
  if (options.replay_durations) line += " --replay-durations " + options.replay_durations->string();
  for (const std::string& assignment : options.assignments) line += " --set '" + assignment + "'";
  return line;
}

bridge::RunResult carry_out(const RunOptions& options, const bridge::Scenario& scenario, std::uint64_t seed,
                            bridge::Experiment& experiment, Outputs& outputs) {
  const Time until = Time() + options.until.value_or(scenario.until);
  outputs.watch(experiment.simulation());
  Progress progress(stderr, isatty(STDERR_FILENO) != 0, until.since_start());
  const Pacing pacing(options.speed);
  const double start_s = wall_clock_s();
  RunEnd end = RunEnd::time_reached;
  Time reached;
  for (std::int64_t k = 1; end == RunEnd::time_reached && reached < until && interrupted == 0; ++k) {
    reached = std::min(until, Time() + window * k);
    end = experiment.run_before(reached);
    progress.update(reached, experiment.goals_reached(), experiment.goals());
    if (k % windows_per_second == 0 || end != RunEnd::time_reached || reached == until)
      outputs.second(experiment.simulation(), (k + windows_per_second - 1) / windows_per_second);
    pacing.wait_for(reached, [] { return interrupted != 0; });
  }
  progress.finish();

  bridge::RunResult result = experiment.result();
  result.seed = seed;
  if (end == RunEnd::time_reached && interrupted != 0) result.outcome = bridge::Outcome::interrupted;
  result.wall_s = wall_clock_s() - start_s;
  const Time last = end == RunEnd::time_reached ? reached : experiment.simulation().global_time();
  result.simulated = last.since_start();
  result.real_time_factor = result.wall_s > 0 ? result.simulated.seconds() / result.wall_s : 0;
  return result;
}

int status(const bridge::Scenario& scenario, const bridge::RunResult& result) {
  if (result.outcome == bridge::Outcome::interrupted) return 130;
  const std::vector<std::string> unmet = bridge::unmet(scenario.expect, result);
  std::fflush(stdout);
  for (const std::string& line : unmet) std::fprintf(stderr, "waitpoint: not as expected: %s\n", line.c_str());
  return unmet.empty() ? 0 : 1;
}

int run_seeds(const RunOptions& options, const bridge::Scenario& scenario, std::span<const genom::ModuleType> types) {
  std::optional<OutputFile> summary;
  if (options.summary) summary.emplace(*options.summary);
  std::vector<bridge::RunResult> results;
  int worst = 0;
  std::fputs(seeds_head().c_str(), stdout);
  for (std::uint64_t seed = options.seeds->first; interrupted == 0; ++seed) {
    bridge::Experiment experiment(scenario, types, {seed, options.order, replay_line(options, seed)});
    RunOptions single = options;
    single.summary.reset();
    Outputs none(single, scenario);
    results.push_back(carry_out(options, scenario, seed, experiment, none));
    std::fputs(seeds_row(results.back()).c_str(), stdout);
    std::fflush(stdout);
    worst = std::max(worst, status(scenario, results.back()));
    if (seed == options.seeds->last) break;
  }
  if (summary) {
    summary->write(summary_json(results));
    summary->commit();
  }
  flush_stdout();
  return interrupted != 0 ? 130 : worst;
}

}  // namespace

int run(const RunOptions& options, std::span<const genom::ModuleType> types) {
  const bridge::Scenario scenario = bridge::read_scenario(options.scenario, options.assignments);
  heed_signals();
  if (options.seeds) return run_seeds(options, scenario, types);
  bridge::Experiment experiment(scenario, types, {options.seed, options.order, replay_line(options, options.seed)});
  Outputs outputs(options, scenario);
  DurationFiles durations(options, scenario, experiment);
  const bridge::RunResult result = carry_out(options, scenario, options.seed, experiment, outputs);
  durations.finish(result.outcome == bridge::Outcome::finished);
  std::fputs(summary_text(result).c_str(), stdout);
  outputs.write(experiment, result);
  flush_stdout();
  return status(scenario, result);
}

}  // namespace waitpoint::tools
