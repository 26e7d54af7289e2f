// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check/checked_run.hpp"

#include <optional>
#include <utility>

#include "modules/playback/playback.hpp"
#include "modules/run/experiment.hpp"
#include "tools/command/system_confinement.hpp"
#include "tools/run/duration_files.hpp"
#include "tools/run/log_run.hpp"

namespace waitpoint::tools {
namespace {

class RunInWorld final : public CheckedRun {
 public:
  RunInWorld(const RunOptions& options, const scenario::Scenario& scenario, std::span<const genom::ModuleType> types,
             const std::string& replay)
      : experiment_(scenario, types, {options.seed, options.order, replay}), given_(options, scenario, experiment_) {
    confine_to_listed_files();
  }

  Simulation& simulation() override { return experiment_.simulation(); }
  RunEnd run_before(Time until) override { return experiment_.run_before(until); }

 private:
  run::Experiment experiment_;
  DurationFiles given_;
};

/// The log is read for each run.
class RunOfLog final : public CheckedRun {
 public:
  RunOfLog(const LogSource& source, const PlayOptions& options, std::span<const genom::ModuleType> types)
      : log_(source.read()), playback_(log_, source.robot, types, options.simulation()) {
    confine_to_listed_files();
  }

  Simulation& simulation() override { return playback_.simulation(); }
  RunEnd run_before(Time until) override { return playback_.run_before(until); }

 private:
  logs::SensorLog log_;
  playback::Playback playback_;
};

}  // namespace

CheckSubject subject_of(const RunOptions& options, const scenario::Scenario& scenario,
                        std::span<const genom::ModuleType> types) {
  const std::string replay = replay_line(options, options.seed);
  CheckSubject subject;
  if (scenario.log) {
    subject = subject_of(log_source(scenario), play_options(options, *scenario.log), replay + " --verify", types);
  } else {
    subject.seed = options.seed;
    subject.until = options.limit(scenario.until);
    subject.command = replay + " --verify";
    subject.replays_durations = options.replay_durations.has_value();
    subject.make = [&options, &scenario, types, replay] {
      return std::make_unique<RunInWorld>(options, scenario, types, replay);
    };
  }
  subject.name = scenario.name;
  return subject;
}

CheckSubject subject_of(LogSource source, const PlayOptions& options, const std::string& command,
                        std::span<const genom::ModuleType> types) {
  CheckSubject subject;
  subject.name = source.file.string();
  subject.seed = options.seed;
  subject.until = source.end(options.until);
  subject.command = command;
  subject.make = [source = std::move(source), options, types] {
    return std::make_unique<RunOfLog>(source, options, types);
  };
  return subject;
}

}  // namespace waitpoint::tools
