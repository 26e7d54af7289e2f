// SPDX-License-Identifier: BSD-3-Clause
// The options of `waitpoint explore` as values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "fibers/explore/strategies/switch_points.hpp"
#include "fibers/explore/target/explore_options.hpp"
#include "tools/command/options/results.hpp"
#include "tools/command/options/scenario.hpp"
#include "tools/command/options/viewing.hpp"
#include "tools/exec/program_conditions.hpp"

namespace waitpoint::tools {

/// One machine's part of a search: every `count`-th schedule, starting with number `index` - 1.
struct Shard {
  std::uint64_t index = 1, count = 1;
};

/// The options of any exploration, and those of `waitpoint explore` alone. The assignments are those of --set, then
/// those of --property: "expect.collisions=0".
struct ExploreOptions : waitpoint::ExploreOptions, ScenarioOptions {
  ExploreOptions() {
    iterations = 1000;
    until = Time::max();
  }

  std::vector<std::string> program;     ///< its words; instead of a scenario, or for it
  bool has_nodes = false;               ///< `program` is the run of `scenario`: see run_with_nodes.hpp
  std::size_t sets = 0;                 ///< so many of them are of --set
  std::vector<std::string> properties;  ///< of --property: "collisions=0"
  bool seed_is_asked = false;           ///< given explicitly
  std::uint32_t jobs = 1;               ///< processes at once
  std::optional<Duration> from;         ///< the end of the part that all schedules share
  Shard shard;
  OptionalFile results, trace, schedule, page, finding;  ///< output files
  std::optional<ServeAddress> serve;                     ///< where browsers see the search and its finding
  bool keep_all = false;                                 ///< --no-minimize
  bool json = false;                                     ///< the result as JSON to standard output
  bool forks_each = false;                               ///< each schedule of a program has a process of its own
  std::uint32_t snapshots = 0;                           ///< of a program: the most that are kept
  std::uint32_t observed = 20;                           ///< schedules before it is said that no other ordering exists
  ProgramConditions conditions;                          ///< of a program
  SwitchAt switch_at = SwitchAt::automatic;              ///< of a program without -fsanitize=thread
  std::vector<std::string> libraries;                    ///< of --switch-at: their accesses are switch points, too

  /// The failure is wanted with its events, for a page.
  bool tells_finding() const { return page || finding || serve; }
  /// The end of a run, for a scenario whose own limit is `own`.
  Time limit(Duration own) const { return has_until() ? until : Time() + own; }
  /// `until` overrides the scenario's limit.
  bool has_until() const { return until != Time::max(); }
};

/// The command with its options.
void declare(Command& command, ExploreOptions& options);

}  // namespace waitpoint::tools
