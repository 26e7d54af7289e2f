// SPDX-License-Identifier: BSD-3-Clause
// What `waitpoint run SCENARIO ...` is asked for, as values. Nothing is opened or run here.
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
  std::filesystem::path scenario;
  std::vector<std::string> assignments;  ///< of --set, in their order: "world.step_ms=5"
  std::uint64_t seed = 1;
  std::optional<SeedRange> seeds;  ///< instead of `seed`
  std::optional<Duration> until;   ///< instead of the scenario's
  kernel::Order order = kernel::Order::fifo;
  double speed = 0;  ///< simulated seconds a second; 0: as fast as it goes
  bool interactive = false;
  std::optional<std::filesystem::path> journal;         ///< to write
  std::optional<std::filesystem::path> replay_journal;  ///< to carry out again
  bool check = false;  ///< whether it is the same run again, instead of what it came to
  std::optional<std::filesystem::path> summary, picture, trajectory, record, digests, events;
  std::optional<std::filesystem::path> record_durations, replay_durations;  ///< not both

  /// When a run ends at the latest, of a scenario that says `own`.
  Time limit(Duration own) const { return Time() + until.value_or(own); }
};

/// The command that carries out the run of this seed again.
std::string replay_line(const RunOptions& options, std::uint64_t seed);

/// The scenario's file and --set, of each command that reads a scenario.
struct ScenarioArguments {
  std::string file;
  std::vector<std::string> assignments;

  void add_file(Command& command);
  void add_set(Command& command);
};

/// The arguments as they are written.
class RunArguments {
 public:
  /// Adds the command with its options.
  explicit RunArguments(CommandLine& line);

  /// Whether the command line has it.
  bool parsed() const { return command_.parsed(); }
  /// What they say, with WAITPOINT_SEED where --seed is not given; BadInput where they cannot be meant.
  RunOptions options() const;

 private:
  void check_of_many(const char* option) const;
  void check_writes_nothing() const;
  void check_alone() const;

  Command command_;
  ScenarioArguments scenario_;
  std::string seed_, seeds_, order_, until_, speed_, journal_, replay_journal_;
  std::string summary_, picture_, trajectory_, record_, digests_, events_;
  std::string record_durations_, replay_durations_;
  bool interactive_ = false, check_ = false;
};

}  // namespace waitpoint::tools
