// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint explore`: runs a scenario or a program under many schedules, and reports the first failure.
#pragma once

#include <span>

#include "modules/genom/module_type.hpp"
#include "tools/explore/runs/explore_options.hpp"

namespace waitpoint::tools {

/// Returns the exit status: 0 if no schedule failed, 1 if one did, 130 if a signal ended the search. Throws BadInput
/// before anything is run or written.
int explore(const ExploreOptions& options, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
