// SPDX-License-Identifier: BSD-3-Clause
// The options of `waitpoint explore` as values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "fibers/explore/explore_options.hpp"
#include "tools/command/command_line.hpp"
#include "tools/command/confinement_options.hpp"
#include "tools/exec/program_conditions.hpp"
#include "tools/exec/switch_at.hpp"

namespace waitpoint::tools {

/// One machine's part of a search: every `count`-th schedule, starting with number `index` - 1.
struct Shard {
  std::uint64_t index = 1, count = 1;
};

/// The options of any exploration, and those of `waitpoint explore` alone.
struct ExploreOptions : waitpoint::ExploreOptions {
  ExploreOptions() {
    iterations = 1000;
    until = Time::max();
  }

  std::filesystem::path scenario;
  std::vector<std::filesystem::path> confined_to;  ///< the only folders to read from; empty: all
  std::vector<std::string> program;                ///< its words; instead of a scenario, or for it
  bool has_nodes = false;                          ///< `program` is the run of `scenario`: see run_with_nodes.hpp
  std::vector<std::string> assignments;            ///< of --set, then of --property: "expect.collisions=0"
  std::size_t sets = 0;                            ///< so many of them are of --set
  std::vector<std::string> properties;             ///< of --property: "collisions=0"
  bool seed_is_asked = false;                      ///< given explicitly
  std::uint32_t jobs = 1;                          ///< processes at once
  std::optional<Duration> from;                    ///< the end of the part that all schedules share
  Shard shard;
  std::optional<std::filesystem::path> results, trace, schedule, page, finding;  ///< output files
  std::optional<std::string> serve;  ///< address and port at which browsers see the search and its finding; empty: any
  bool json = false;                 ///< the result as JSON to standard output
  bool forks_each = false;           ///< each schedule of a program has a process of its own
  std::uint32_t snapshots = 0;       ///< of a program: the most that are kept
  ProgramConditions conditions;      ///< of a program
  SwitchAt switch_at = SwitchAt::automatic;  ///< of a program without -fsanitize=thread

  /// The failure is wanted with its events, for a page.
  bool tells_finding() const { return page || finding || serve; }
  /// The end of a run, for a scenario whose own limit is `own`.
  Time limit(Duration own) const { return has_until() ? until : Time() + own; }
  /// `until` overrides the scenario's limit.
  bool has_until() const { return until != Time::max(); }
};

/// The arguments as text, and their definition.
class ExploreArguments {
 public:
  /// Adds the command with its options.
  explicit ExploreArguments(CommandLine& line);

  /// True if the command line has this command.
  bool parsed() const { return command_.parsed(); }
  /// The parsed options, with the words after `--`; BadInput for invalid values and combinations.
  ExploreOptions options(const std::vector<std::string>& words) const;

 private:
  void check_program() const;
  void take_program_options(ExploreOptions& options) const;
  void take_outputs(ExploreOptions& options) const;
  void check_exhaustive(const std::string& where, const ExploreOptions& options) const;

  Command command_;
  std::string scenario_, seed_, strategy_, iterations_, time_limit_, schedule_limit_, jobs_, until_, from_, shard_;
  std::string results_, trace_, schedule_, replay_, races_, switch_at_, memory_, snapshots_, serve_world_, page_,
      finding_, serve_;
  std::vector<std::string> assignments_, properties_, external_;
  ConfinementArguments confinement_;
  ConditionArguments conditions_;
  bool is_program_ = false, keep_all_ = false, forks_each_ = false, json_ = false;
};

}  // namespace waitpoint::tools
