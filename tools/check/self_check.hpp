// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint run SCENARIO --verify`, `waitpoint play LOG --verify`: verifies that the run is repeatable.
//
//   first run          its events are logged
//   second run         in the same process: shows effects of an earlier run, clocks, system random numbers
//   third run          in a perturbed process: addresses, uninitialised memory, environment, clock, directories
//
// The second and third runs are compared with the first, event by event, each with its robot's digest so far, and end
// at the first difference, which is reported. Durations that local clocks measured in the first run are replayed in the
// others.
#pragma once

#include <span>

#include "modules/genom/module_type.hpp"
#include "tools/replay/replay_options.hpp"
#include "tools/run/run_options.hpp"

namespace waitpoint::tools {

/// Returns the exit status: 0 if all three runs are equal, 1 if two differ, 130 if a signal ended the check. Throws
/// BadInput where a run would, and if the log or a process cannot be created.
int self_check(const RunOptions& options, std::span<const genom::ModuleType> types);
int self_check(const ReplayOptions& options, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
