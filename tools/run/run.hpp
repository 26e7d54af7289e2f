// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint run`: runs a scenario, shows its progress, writes the requested files.
//
// Unattended, from a prompt (prompt.hpp), or from a journal (modules/run/journal.hpp).
#pragma once

#include <span>

#include "modules/genom/module_type.hpp"
#include "tools/run/run_options.hpp"

namespace waitpoint::tools {

/// Returns the exit status: 0 if the result meets the scenario's expectations, 1 if not, 130 if a signal ended the run.
/// Throws BadInput before anything is run or written.
int run(const RunOptions& options, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
