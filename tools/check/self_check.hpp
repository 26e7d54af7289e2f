// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint run SCENARIO --check`: is it the same run again?
//
//   first run          its events are logged
//   second run         in the same process: what an earlier run leaves behind, clocks, random numbers of the system
//   third run          in a perturbed process: addresses, memory that nobody has set, environment, clock, directories
//
// The second and the third are compared with the first event by event, each with the robot's digest so far, and end
// where they part. The first event that differs is told. What local clocks measured in the first run is replayed in the
// others.
#pragma once

#include <span>

#include "modules/genom/module_type.hpp"
#include "tools/run/run_options.hpp"

namespace waitpoint::tools {

/// Returns the exit status: 0 if all three runs are equal, 1 if two differ, 130 if a signal ended it. Throws BadInput
/// where a run would, and if there is no place for the log or no way to start a process.
int self_check(const RunOptions& options, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
