// SPDX-License-Identifier: BSD-3-Clause
// --replay: repeats one schedule of a program, with its input and output connected as without waitpoint.
#pragma once

#include "tools/explore/runs/explore_options.hpp"

namespace waitpoint::tools {

/// Runs the schedule that options.replay names; reports its outcome and whether it equals the recorded run. Returns the
/// exit status: 0 if it passes and is equal, else 1. BadInput for a token or a file of another target.
int replay_program(const ExploreOptions& options);

}  // namespace waitpoint::tools
