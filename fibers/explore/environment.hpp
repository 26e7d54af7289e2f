// SPDX-License-Identifier: BSD-3-Clause
// What a person asks of a test that explores, without editing it: WAITPOINT_STRATEGY, _SEED, _ITERATIONS, _TIME_LIMIT,
// _REPLAY and _TRACE.
#pragma once

#include "fibers/explore/explore.hpp"

namespace waitpoint::exploration {

/// `options`, but for what the environment says. Throws BadInput, which names the variable.
ExploreOptions with_environment(ExploreOptions options);

/// The file for a trace of what failed; empty where none is asked for.
std::string trace_file();

/// The command that runs this program again, the test `name` of it alone.
std::string command_line(const ForeignChecks* checks);

}  // namespace waitpoint::exploration
