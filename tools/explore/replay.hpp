// SPDX-License-Identifier: BSD-3-Clause
// --replay: one schedule of a scenario again, in this process, so that a debugger sees it.
#pragma once

#include <span>

#include "modules/genom/module_type.hpp"
#include "modules/scenario/scenario.hpp"
#include "tools/explore/explore_options.hpp"

namespace waitpoint::tools {

/// Runs the schedule that options.replay names, prints what it came to and whether it is the same run. Returns the exit
/// status: 0 if it passes and is the same run, else 1. BadInput for a token or a file of something else.
int replay(const ExploreOptions& options, const bridge::Scenario& scenario, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
