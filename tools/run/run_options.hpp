// SPDX-License-Identifier: BSD-3-Clause
// The options of `waitpoint run SCENARIO ...` as values. Opens and runs nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "tools/command/options/results.hpp"
#include "tools/command/options/scenario.hpp"
#include "tools/command/options/schedule.hpp"
#include "tools/command/options/viewing.hpp"
#include "tools/run/run_partners.hpp"
#include "tools/run/run_watchdog.hpp"

namespace waitpoint::tools {

struct RunOptions : ScenarioOptions, ScheduleOptions {
  std::string program = "waitpoint";         ///< for replay lines
  std::uint32_t jobs = 1;                    ///< runs of `seeds` at once
  int ranks = 1;                             ///< processes of one run
  std::string build;                         ///< of this program, for comparison among ranks
  std::vector<std::string> arguments;        ///< of the program, from `run` on, to start it as ranks
  std::optional<Duration> until;             ///< instead of the scenario's
  double speed = 0;                          ///< simulated seconds per second, at most; 0: no limit
  Duration idle = std::chrono::seconds(60);  ///< of a wait without a timeout, to be listed at the end; 0: none are
  double watchdog_s = RunWatchdog::usual_limit_s;  ///< of the wall clock, without an event; 0: unlimited
  bool interactive = false;
  bool tcl = false;                   ///< commands in Tcl from standard input
  OptionalFile journal;               ///< to write
  OptionalFile replay_journal;        ///< to repeat
  PartnerOptions partners;            ///< outside
  std::optional<ServeAddress> serve;  ///< of the viewer
  bool serve_control = false;         ///< viewers may act on the run
  bool json = false;                  ///< the result as JSON to standard output
  bool is_brief = false;              ///< of nodes: see nodes::NodeRunOptions
  bool verify = false;                ///< compare runs instead of reporting a result
  OptionalFile summary, picture, page, trajectory, record, digests, events, decisions;
  OptionalFile record_durations, replay_durations;  ///< not both
  std::vector<NamedFile> files;                     ///< all that options name
  std::vector<std::string> given;                   ///< names of the options that were given

  /// The end of a run, for a scenario whose own limit is `own`.
  Time limit(Duration own) const { return Time() + until.value_or(own); }
  /// True if JSON or one of the output files is on standard output, where no other text may be then.
  bool writes_standard_output() const;
};

/// The command with its options.
void declare(Command& command, RunOptions& options);

/// Throws BadInput unless all files are distinct, including those that --trajectory derives from the names of `robots`.
void check_files(const RunOptions& options, std::span<const std::string> robots);

/// Throws BadInput, with this message, if one of these options was given.
void check_none_given(const RunOptions& options, std::span<const char* const> names, const std::string& message);

/// The command that repeats the run of this seed, for a shell.
std::string replay_line(const RunOptions& options, std::uint64_t seed);

}  // namespace waitpoint::tools
