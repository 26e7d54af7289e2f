// SPDX-License-Identifier: BSD-3-Clause
// The options of `waitpoint exec [OPTIONS] -- PROGRAM ARGUMENTS...`. Words after the dashes are not interpreted.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/command/options/schedule.hpp"
#include "tools/exec/program_conditions.hpp"

namespace waitpoint::tools {

struct ExecOptions : ScheduleOptions {
  ExecOptions() { order = kernel::Order::seeded; }

  ProgramConditions conditions;
  std::optional<std::filesystem::path> trace;  ///< output file
  bool quiet = false;
  bool json = false;               ///< the result as JSON to standard output, where the program has no output then
  std::string replay;              ///< the command that repeats the run, if it is not this one
  std::vector<std::string> words;  ///< the program and its arguments; not empty
};

/// The command with its options.
void declare(Command& command, ExecOptions& options);

}  // namespace waitpoint::tools
