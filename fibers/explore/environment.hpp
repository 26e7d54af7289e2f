// SPDX-License-Identifier: BSD-3-Clause
// Options of exploring tests set by the environment: WAITPOINT_STRATEGY, _SEED, _ITERATIONS, _TIME_LIMIT,
// _SCHEDULE_LIMIT, _RACES, _MEMORY, _REPLAY, _TRACE and _FINDING.
#pragma once

#include "core/error.hpp"
#include "fibers/explore/body.hpp"
#include "fibers/explore/target/explore_options.hpp"

namespace waitpoint::exploration {

/// `options`, overridden by the environment. Throws BadInput, which names the variable.
ExploreOptions with_environment(ExploreOptions options);

/// If the environment sets options, ends the program with a line for the error and status 2: the user's environment is
/// at fault, not a test.
void refuse_environment(const BadInput& input);

/// True if WAITPOINT_REPLAY is set: the token is then the user's, not the test's own.
bool has_replay_variable();

/// Call this before replaying the run of WAITPOINT_REPLAY. A program that ends without such a call reports it and exits
/// with status 2.
void mark_replay_reached();

/// The file for a trace of the failure; empty if none is requested.
std::string trace_file();
/// The file for the failure as a finding, for `waitpoint view`; empty if none is requested.
std::string finding_file();

/// The command that reruns this program with its arguments, restricted to the running test.
std::string command_line(const ExternalChecks* checks);

}  // namespace waitpoint::exploration
