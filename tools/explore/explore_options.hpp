// SPDX-License-Identifier: BSD-3-Clause
// What `waitpoint explore` is asked for, as values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "tools/command/command_line.hpp"
#include "tools/exec/program_conditions.hpp"

namespace waitpoint::tools {

/// The part of a campaign that one machine does: every `count`-th schedule, from number `index` - 1 on.
struct Shard {
  std::uint64_t index = 1, count = 1;
};

struct ExploreOptions {
  std::filesystem::path scenario;
  std::vector<std::string> program;      ///< instead of a scenario: its words
  std::vector<std::string> assignments;  ///< of --set, then those of --property: "expect.collisions=0"
  std::vector<std::string> properties;   ///< of --property: "collisions=0"
  std::string strategy = "portfolio";
  std::uint64_t seed = 1;
  bool seed_is_asked = false;                   ///< and not the default
  std::uint64_t iterations = 1000;              ///< schedules, at most, of all shards
  double time_limit_s = 0;                      ///< of the wall clock; 0: none
  std::optional<double> schedule_limit_s = {};  ///< of one schedule; 0: none; else by what the default order takes
  std::uint32_t jobs = 1;                       ///< processes at once
  std::optional<Duration> until;                ///< instead of the scenario's
  std::optional<Duration> from;                 ///< to where all schedules are one
  Shard shard;
  std::optional<std::filesystem::path> results, trace, schedule;  ///< to write
  std::string replay;                                             ///< a token or a file's name: that one alone
  bool minimize = true;
  ProgramConditions conditions;  ///< of a program

  /// When a run ends at the latest, of a scenario that says `own`.
  Time limit(Duration own) const { return Time() + until.value_or(own); }
};

/// The arguments as they are written, and their place on the command line.
class ExploreArguments {
 public:
  /// Adds the command with its options.
  explicit ExploreArguments(CommandLine& line);

  /// Whether the command line has it.
  bool parsed() const { return command_.parsed(); }
  /// What they say, with the words behind `--`; BadInput where they cannot be meant.
  ExploreOptions options(const std::vector<std::string>& words) const;

 private:
  void check_program() const;
  void check_exhaustive(const std::string& where, const ExploreOptions& options) const;

  Command command_;
  std::string scenario_, seed_, strategy_, iterations_, time_limit_, schedule_limit_, jobs_, until_, from_, shard_;
  std::string results_, trace_, schedule_, replay_;
  std::vector<std::string> assignments_, properties_;
  ConditionArguments conditions_;
  bool is_program_ = false, keep_all_ = false;
};

}  // namespace waitpoint::tools
