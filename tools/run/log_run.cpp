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
  const std::pair<const char*, bool> of_worlds[] = {
      {"--seeds", options.seeds.has_value()},
      {"--speed", options.speed != 0},
      {"--idle", options.idle != RunOptions().idle},
      {"--interactive", options.interactive},
      {"--tcl", options.tcl},
      {options.partners.name(), options.partners.any()},
      {"--journal", options.journal.has_value()},
      {"--replay-journal", options.replay_journal.has_value()},
      {"--record", options.record.has_value()},
      {"--page", options.page.has_value()},
      {"--serve", options.serve.has_value()},
      {"--decisions", options.decisions.has_value()},
      {"--record-durations", options.record_durations.has_value()},
      {"--replay-durations", options.replay_durations.has_value()},
  };
  for (const auto& [option, is_given] : of_worlds)
    if (is_given) throw BadInput(option, "expected a scenario with a world, found the log of " + log.written.text());
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
  play.digests = options.digests;
  play.events = options.events;
  const auto name = [](const std::optional<std::filesystem::path>& file) { return file ? file->string() : ""; };
  check_distinct({{"--summary", name(play.summary)},
                  {"--picture", name(play.picture)},
                  {"--trajectory", name(play.trajectory)},
                  {"--digests", name(play.digests)},
                  {"--events", name(play.events)},
                  {"the scenario", options.scenario.string(), NamedFile::Use::read},
                  {"the scenario's log", log.file.string(), NamedFile::Use::read}});
  return play;
}

int run_log(const RunOptions& options, const scenario::Scenario& scenario, std::span<const genom::ModuleType> types) {
  return play_log(log_source(scenario), play_options(options, *scenario.log), types);
}

}  // namespace waitpoint::tools
