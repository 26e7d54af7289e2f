// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint check SCENARIO`: reads a scenario and assembles its run, without running it.
#pragma once

#include <span>

#include "modules/genom/module_type.hpp"
#include "tools/command/options/scenario.hpp"

namespace waitpoint::tools {

struct CheckOptions : ScenarioOptions {
  bool json = false;   ///< the result as JSON to standard output
  bool files = false;  ///< list what the scenario names
};

/// The command with its options.
void declare(Command& command, CheckOptions& options);

/// Prints what the scenario has; returns the exit status. BadInput for a scenario that cannot be run.
int check(const CheckOptions& options, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
