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
#include "fibers/kernel/chooser.hpp"
#include "tools/command/command_line.hpp"
#include "tools/command/confinement_options.hpp"
#include "tools/command/option_values.hpp"
#include "tools/run/run_partners.hpp"
#include "tools/run/run_watchdog.hpp"

namespace waitpoint::tools {

struct RunOptions {
  std::string program = "waitpoint";  ///< for replay lines
  std::filesystem::path scenario;
  std::vector<std::filesystem::path> confined_to;  ///< the only folders to read from; empty: all
  std::vector<std::string> assignments;            ///< of --set, in their order: "world.step_ms=5"
  std::uint64_t seed = 1;
  std::optional<SeedRange> seeds;      ///< instead of `seed`
  std::uint32_t jobs = 1;              ///< runs of `seeds` at once
  int ranks = 1;                       ///< processes of one run
  std::string build;                   ///< of this program, for comparison among ranks
  std::vector<std::string> arguments;  ///< of the program, as given, to start it as ranks
  std::optional<Duration> until;       ///< instead of the scenario's
  kernel::Order order = kernel::Order::fifo;
  double speed = 0;                          ///< simulated seconds per second; 0: unthrottled
  Duration idle = std::chrono::seconds(60);  ///< of a wait without a timeout, to be listed at the end; 0: none are
  double watchdog_s = RunWatchdog::usual_limit_s;  ///< of the wall clock, without an event; 0: unlimited
  bool interactive = false;
  bool tcl = false;                                     ///< commands in Tcl from standard input
  std::optional<std::filesystem::path> journal;         ///< to write
  std::optional<std::filesystem::path> replay_journal;  ///< to repeat
  PartnerOptions partners;                              ///< outside
  std::optional<std::string> serve;                     ///< ADDRESS:PORT of the viewer
  bool serve_control = false;                           ///< viewers may act on the run
  bool json = false;                                    ///< the result as JSON to standard output
  bool is_brief = false;                                ///< of nodes: see nodes::NodeRunOptions
  bool check = false;                                   ///< self-check: compare runs instead of reporting a result
  std::optional<std::filesystem::path> summary, picture, page, trajectory, record, digests, events, decisions;
  std::optional<std::filesystem::path> record_durations, replay_durations;  ///< not both

  /// The end of a run, for a scenario whose own limit is `own`.
  Time limit(Duration own) const { return Time() + until.value_or(own); }
  /// True if JSON or one of the output files is on standard output, where no other text may be then.
  bool writes_standard_output() const;
};

/// Throws BadInput unless all files are distinct, including those that --trajectory derives from the names of `robots`
/// (if none are given: of a single robot).
void check_files(const RunOptions& options, std::span<const std::string> robots);

/// The command that repeats the run of this seed, for a shell.
std::string replay_line(const RunOptions& options, std::uint64_t seed);

/// The scenario's file and --set, shared by the commands that read a scenario.
struct ScenarioArguments {
  ConfinementArguments confinement;
  std::string file;
  std::vector<std::string> assignments;

  void add_file(Command& command);
  void add_set(Command& command);
};

/// The arguments as text.
class RunArguments {
 public:
  /// Adds the command with its options.
  explicit RunArguments(CommandLine& line);

  /// True if the command line has this command.
  bool parsed() const { return command_.parsed(); }
  /// The parsed options, with WAITPOINT_SEED if --seed is not given. BadInput for invalid values and combinations.
  RunOptions options() const;

 private:
  void add_outputs();
  void check_of_many(const char* option) const;
  void check_writes_nothing() const;
  void check_alone() const;
  void check_outputs(RunOptions& options) const;
  void check_for_ranks() const;
  void check_partners(double speed) const;
  void take_served(RunOptions& options) const;

  Command command_;
  ScenarioArguments scenario_;
  std::string seed_, seeds_, jobs_, ranks_, order_, until_, speed_, watchdog_, idle_, journal_, replay_journal_;
  std::string serve_, summary_, picture_, page_, trajectory_, record_, digests_, events_, decisions_;
  std::string record_durations_, replay_durations_, play_;
  PartnerOptions partners_;
  bool serve_control_ = false, interactive_ = false, tcl_ = false, check_ = false, is_brief_ = false, json_ = false;
};

}  // namespace waitpoint::tools
