// SPDX-License-Identifier: BSD-3-Clause
// The options of `waitpoint exec [OPTIONS] -- PROGRAM ARGUMENTS...`. None of the words behind the dashes is looked at.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fibers/kernel/chooser.hpp"
#include "tools/command/command_line.hpp"
#include "tools/command/option_values.hpp"
#include "tools/exec/program_conditions.hpp"

namespace waitpoint::tools {

struct ExecOptions {
  std::uint64_t seed = 1;
  kernel::Order order = kernel::Order::seeded;
  std::optional<SeedRange> seeds;  ///< instead of `seed`: a run for each, to the first that fails
  ProgramConditions conditions;
  std::optional<std::filesystem::path> trace;  ///< to write
  bool quiet = false;
  std::vector<std::string> words;  ///< the program and its arguments: at least one
};

/// The arguments as they are written.
class ExecArguments {
 public:
  /// Adds the command with its options.
  explicit ExecArguments(CommandLine& line);

  /// Whether the command line has it.
  bool parsed() const { return command_.parsed(); }
  /// What they say, for a program of these words; BadInput where they cannot be meant.
  ExecOptions options(const std::vector<std::string>& words) const;

 private:
  Command command_;
  std::string seed_, seeds_, trace_, strategy_ = "random";
  bool quiet_ = false;
  ConditionArguments conditions_;
};

}  // namespace waitpoint::tools
