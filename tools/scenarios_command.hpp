// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint scenarios`: the shipped scenarios, each with its `description`.
#pragma once

#include "tools/command/command.hpp"

namespace waitpoint::tools {

struct ScenariosOptions {
  bool json = false;  ///< the result as JSON to standard output
};

/// The command with its options.
void declare(Command& command, ScenariosOptions& options);

/// Prints name and description of each; returns the exit status.
int list_scenarios(const ScenariosOptions& options);

}  // namespace waitpoint::tools
