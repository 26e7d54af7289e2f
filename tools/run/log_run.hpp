// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint run` of a scenario with a log in place of a world: as `waitpoint play LOG --scenario SCENARIO`.
#pragma once

#include <span>

#include "modules/genom/module_type.hpp"
#include "modules/scenario/scenario.hpp"
#include "tools/replay/replay_options.hpp"
#include "tools/run/run_options.hpp"

namespace waitpoint::tools {

/// The options of `run` as of a replay. BadInput for options that need a world, and if the log is a file that an option
/// writes.
PlayOptions play_options(const RunOptions& options, const scenario::LogFile& log);

/// Returns the exit status of the replay. BadInput as of a replay, and as above.
int run_log(const RunOptions& options, const scenario::Scenario& scenario, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
