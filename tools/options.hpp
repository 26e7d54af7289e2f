// SPDX-License-Identifier: BSD-3-Clause
// The options of `waitpoint` as values. Opens and runs nothing.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "tools/exec/exec_options.hpp"
#include "tools/explore/runs/explore_options.hpp"
#include "tools/finding/view_command.hpp"
#include "tools/fit/compare.hpp"
#include "tools/fit/fit.hpp"
#include "tools/gdb/debug.hpp"
#include "tools/genom/genom.hpp"
#include "tools/plan/plan_command.hpp"
#include "tools/replay/replay_options.hpp"
#include "tools/run/run_options.hpp"
#include "tools/schema/schema_command.hpp"

namespace waitpoint::tools {

/// `waitpoint check SCENARIO ...`
struct CheckOptions {
  std::filesystem::path scenario;
  std::vector<std::filesystem::path> confined_to;  ///< the only folders to read from; empty: all
  std::vector<std::string> assignments;
  bool json = false;  ///< the result as JSON to standard output
};

/// `--help`, `--version`: text to print before exiting.
struct ShownText {
  std::string text;
};

using Options =
    std::variant<RunOptions, CheckOptions, ExploreOptions, ExecOptions, DebugOptions, PlanOptions, GenomOptions,
                 ReplayOptions, FitOptions, CompareOptions, ViewOptions, SchemaOptions, ShownText>;

/// Reads the arguments, and WAITPOINT_SEED unless --seed is given. Throws BadInput, one line, for invalid arguments.
/// `version` is the text of --version.
Options read_options(int argc, const char* const* argv, const std::string& version);

}  // namespace waitpoint::tools
