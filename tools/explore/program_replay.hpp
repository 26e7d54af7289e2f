// SPDX-License-Identifier: BSD-3-Clause
// --replay: one schedule of a program again, with its input and output as they are without waitpoint.
#pragma once

#include "tools/explore/explore_options.hpp"

namespace waitpoint::tools {

/// Runs the schedule that options.replay names, and says what it came to and whether it is the same run. Returns the
/// exit status: 0 if it passes and is the same run, else 1. BadInput for a token or a file of something else.
int replay_program(const ExploreOptions& options);

}  // namespace waitpoint::tools
