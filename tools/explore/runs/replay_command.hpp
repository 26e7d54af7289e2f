// SPDX-License-Identifier: BSD-3-Clause
// The commands that repeat a target's run with its options.
#pragma once

#include <string>

#include "tools/explore/runs/explore_options.hpp"

namespace waitpoint::tools {

/// With `replayed`, a token or a file's name, that schedule.
std::string replay_command(const ExploreOptions& options, const std::string& replayed = "");
/// The same in gdb.
std::string debug_command(const ExploreOptions& options, const std::string& replayed);

}  // namespace waitpoint::tools
