// SPDX-License-Identifier: BSD-3-Clause
// What a person asks of a test that explores, without editing it: WAITPOINT_STRATEGY, _SEED, _ITERATIONS, _TIME_LIMIT,
// _SCHEDULE_LIMIT, _REPLAY and _TRACE.
#pragma once

#include "core/error.hpp"
#include "fibers/explore/body.hpp"
#include "fibers/explore/explore_options.hpp"

namespace waitpoint::exploration {

/// `options`, but for what the environment says. Throws BadInput, which names the variable.
ExploreOptions with_environment(ExploreOptions options);

/// Where the environment asks for something, ends the program with a line that says what is wrong with it, and status
/// 2: it is whoever started the program, and no test, that is at fault.
void refuse_environment(const BadInput& input);

/// Whether WAITPOINT_REPLAY is set: a token is whoever started the program's, not the test's own.
bool asks_for_replay();

/// The run that WAITPOINT_REPLAY asks for is about to be replayed. A program that ends without, says so and ends with
/// status 2.
void replay_was_come_to();

/// The file for a trace of what failed; empty where none is asked for.
std::string trace_file();

/// The command that runs this program again, with its arguments, and of its tests the running one alone.
std::string command_line(const ForeignChecks* checks);

}  // namespace waitpoint::exploration
