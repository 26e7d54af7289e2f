// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint run`: carries out a scenario, shows how far it has come, writes what was asked for.
//
// At once, or from a prompt (prompt.hpp), or as a journal says (modules/run/journal.hpp).
#pragma once

#include <span>

#include "modules/genom/module_type.hpp"
#include "tools/run/run_options.hpp"

namespace waitpoint::tools {

/// Returns the exit status: 0 if the run came to what the scenario expects, 1 if not,
/// 130 if a signal ended it. Throws BadInput before anything is run or written.
int run(const RunOptions& options, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
