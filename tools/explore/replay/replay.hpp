// SPDX-License-Identifier: BSD-3-Clause
// --replay: repeats one schedule of a scenario in this process, for debuggers.
#pragma once

#include <span>

#include "modules/genom/module_type.hpp"
#include "modules/scenario/scenario.hpp"
#include "tools/explore/runs/explore_options.hpp"

namespace waitpoint::tools {

/// Runs the schedule that options.replay names; prints its outcome and whether it equals the recorded run. Returns the
/// exit status: 0 if it passes and is equal, else 1. BadInput for a token or a file of another target.
int replay(const ExploreOptions& options, const scenario::Scenario& scenario, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
