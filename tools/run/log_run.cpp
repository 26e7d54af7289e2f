// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/log_run.hpp"

#include <utility>

#include "core/error.hpp"
#include "tools/command/distinct_files.hpp"
#include "tools/replay/replay.hpp"

namespace waitpoint::tools {
namespace {

/// Of the options that run has and a replay lacks, none is given.
void check_no_world(const RunOptions& options, const scenario::LogFile& log) {
  constexpr const char* of_worlds[] = {
      "--seeds",       "--speed",   "--idle",           "--interactive",      "--tcl",
      "--external",    "--journal", "--replay-journal", "--record",           "--page",
      "--serve-world", "--serve",   "--decisions",      "--record-durations", "--replay-durations"};
  check_none_given(options, of_worlds, "expected a scenario with a world, found the log of " + log.written.text());
}

}  // namespace

PlayOptions play_options(const RunOptions& options, const scenario::LogFile& log) {
  check_no_world(options, log);
  PlayOptions play;
  play.seed = options.seed;
  play.order = options.order;
  play.until = options.until;
  play.trajectory = options.trajectory;
  play.summary = options.summary;
  play.picture = options.picture;
  play.json = options.json;
  play.command = "run";
  play.replay = replay_line(options, options.seed);
  play.digests = options.digests;
  play.events = options.events;
  std::vector<NamedFile> files = options.files;
  files.push_back({"the scenario's log", log.file.string(), NamedFile::Use::read});
  check_distinct(files);
  return play;
}

int run_log(const RunOptions& options, const scenario::Scenario& scenario, std::span<const genom::ModuleType> types) {
  return play_log(log_source(scenario), play_options(options, *scenario.log), types);
}

}  // namespace waitpoint::tools
