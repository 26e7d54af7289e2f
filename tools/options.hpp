// SPDX-License-Identifier: BSD-3-Clause
// What the command line of `waitpoint` asks for, as values. Nothing is opened or run here.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "tools/exec/exec_options.hpp"
#include "tools/explore/explore_options.hpp"
#include "tools/gdb/debug.hpp"
#include "tools/run/run_options.hpp"

namespace waitpoint::tools {

/// `waitpoint check SCENARIO ...`
struct CheckOptions {
  std::filesystem::path scenario;
  std::vector<std::string> assignments;
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
