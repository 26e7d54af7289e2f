// SPDX-License-Identifier: BSD-3-Clause
// The options of `waitpoint` as values. Opens and runs nothing.
#pragma once

#include <string>
#include <variant>

#include "tools/check_command.hpp"
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
#include "tools/scenarios_command.hpp"
#include "tools/schema/schema_command.hpp"

namespace waitpoint::tools {

/// `--help`, `--version`, and the commands that describe the others: text to print before exiting.
struct ShownText {
  std::string text;
};

using Options =
    std::variant<RunOptions, CheckOptions, ExploreOptions, ExecOptions, DebugOptions, PlanOptions, GenomOptions,
                 ReplayOptions, FitOptions, CompareOptions, ViewOptions, ScenariosOptions, SchemaOptions, ShownText>;

/// Reads the arguments, and WAITPOINT_SEED unless --seed is given. Throws BadInput, one line, for invalid arguments.
/// `version` is the text of --version.
Options read_options(int argc, const char* const* argv, const std::string& version);

}  // namespace waitpoint::tools
