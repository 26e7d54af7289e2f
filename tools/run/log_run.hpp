// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint run` of a scenario with a log in place of a world: as `waitpoint replay LOG --scenario SCENARIO`.
#pragma once

#include <span>

#include "modules/genom/module_type.hpp"
#include "modules/scenario/scenario.hpp"
#include "tools/run/run_options.hpp"

namespace waitpoint::tools {

/// Returns the exit status of the replay. BadInput for options that need a world, as of a replay, and if the log is a
/// file that an option writes.
int run_log(const RunOptions& options, const scenario::Scenario& scenario, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
