// SPDX-License-Identifier: BSD-3-Clause
// The options of `waitpoint exec [OPTIONS] -- PROGRAM ARGUMENTS...`. Words after the dashes are not interpreted.
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
  std::optional<SeedRange> seeds;  ///< instead of `seed`: a run of each, up to the first failure
  ProgramConditions conditions;
  std::optional<std::filesystem::path> trace;  ///< output file
  bool quiet = false;
  bool json = false;               ///< the result as JSON to standard output, where the program has no output then
  std::string replay;              ///< the command that repeats the run, if it is not this one
  std::vector<std::string> words;  ///< the program and its arguments; not empty
};

/// The arguments as text.
class ExecArguments {
 public:
  /// Adds the command with its options.
  explicit ExecArguments(CommandLine& line);

  /// True if the command line has this command.
  bool parsed() const { return command_.parsed(); }
  /// The parsed options, for a program of these words; BadInput for invalid values and combinations.
  ExecOptions options(const std::vector<std::string>& words) const;

 private:
  Command command_;
  std::string seed_, seeds_, trace_, strategy_ = "random";
  bool quiet_ = false, json_ = false;
  ConditionArguments conditions_;
};

}  // namespace waitpoint::tools
