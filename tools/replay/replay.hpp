// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint play LOG`: a robot's modules on a recorded log in the place of a world.
#pragma once

#include <span>

#include "modules/genom/module_type.hpp"
#include "tools/replay/log_source.hpp"
#include "tools/replay/replay_options.hpp"

namespace waitpoint::tools {

/// Plays the log, prints the summary and writes the files. Returns the exit status: 0; 1 after a deadlock; 130 after a
/// signal. BadInput for logs and settings that are not as they must be.
int play_log(const LogSource& source, const PlayOptions& options, std::span<const genom::ModuleType> types);

/// The same for the source that the options name; also BadInput for its scenario.
int replay_log(const ReplayOptions& options, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
