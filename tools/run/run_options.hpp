// SPDX-License-Identifier: BSD-3-Clause
// The options of `waitpoint run SCENARIO ...` as values. Opens and runs nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "fibers/kernel/chooser.hpp"
#include "tools/command/command_line.hpp"
#include "tools/command/option_values.hpp"

namespace waitpoint::tools {

struct RunOptions {
  std::string program = "waitpoint";  ///< for replay lines
  std::filesystem::path scenario;
  std::vector<std::string> assignments;  ///< of --set, in their order: "world.step_ms=5"
  std::uint64_t seed = 1;
  std::optional<SeedRange> seeds;  ///< instead of `seed`
  std::optional<Duration> until;   ///< instead of the scenario's
  kernel::Order order = kernel::Order::fifo;
  double speed = 0;        ///< simulated seconds per second; 0: unthrottled
  double watchdog_s = 10;  ///< of the wall clock, without an event; 0: unlimited
  bool interactive = false;
  std::optional<std::filesystem::path> journal;         ///< to write
  std::optional<std::filesystem::path> replay_journal;  ///< to repeat
  bool check = false;                                   ///< self-check: compare runs instead of reporting a result
  std::optional<std::filesystem::path> summary, picture, trajectory, record, digests, events;
  std::optional<std::filesystem::path> record_durations, replay_durations;  ///< not both

  /// The end of a run, for a scenario whose own limit is `own`.
  Time limit(Duration own) const { return Time() + until.value_or(own); }
};

/// The command that repeats the run of this seed.
std::string replay_line(const RunOptions& options, std::uint64_t seed);

/// The scenario's file and --set, shared by the commands that read a scenario.
struct ScenarioArguments {
  std::string file;
  std::vector<std::string> assignments;

  void add_file(Command& command);
  void add_set(Command& command);
  /// The scenario's file; a name without a folder that is not here may be one of the installed scenarios.
  std::filesystem::path path() const;
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
  void check_of_many(const char* option) const;
  void check_writes_nothing() const;
  void check_alone() const;

  Command command_;
  ScenarioArguments scenario_;
  std::string seed_, seeds_, order_, until_, speed_, watchdog_, journal_, replay_journal_;
  std::string summary_, picture_, trajectory_, record_, digests_, events_;
  std::string record_durations_, replay_durations_;
  bool interactive_ = false, check_ = false;
};

}  // namespace waitpoint::tools
