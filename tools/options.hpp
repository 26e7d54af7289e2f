// SPDX-License-Identifier: BSD-3-Clause
// What the command line of `waitpoint` asks for, as values. Nothing is opened or run here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/time.hpp"
#include "fibers/kernel/chooser.hpp"
#include "tools/command/option_values.hpp"
#include "tools/exec/exec_options.hpp"
#include "tools/explore/explore_options.hpp"

namespace waitpoint::tools {

/// `waitpoint run SCENARIO ...`
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

/// `waitpoint check SCENARIO ...`
struct CheckOptions {
  std::filesystem::path scenario;
  std::vector<std::string> assignments;
};

/// `waitpoint gdb [OPTIONS OF GDB] -- PROGRAM ...`
struct DebugOptions {
  std::vector<std::string> gdb_options;
  bool own = false;                ///< the words after `--` are a command of this program
  std::vector<std::string> words;  ///< at least one
};

/// `--help`, `--version`: to be printed, and that is all.
struct ShownText {
  std::string text;
};

using Options = std::variant<RunOptions, CheckOptions, ExploreOptions, ExecOptions, DebugOptions, ShownText>;

/// Reads the arguments, and WAITPOINT_SEED where --seed is not given. Throws BadInput, one clear line, for what it does
/// not understand. `version` is the text of --version.
Options read_options(int argc, const char* const* argv, const std::string& version);

}  // namespace waitpoint::tools
