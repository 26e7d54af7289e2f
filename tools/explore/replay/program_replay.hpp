// SPDX-License-Identifier: BSD-3-Clause
// --replay: repeats one schedule of a program. Its streams are those of a search, whatever the streams of this process
// are: the input is a file or empty, the output is shown while it is written.
#pragma once

#include <functional>

#include "tools/exec/program_process.hpp"
#include "tools/explore/runs/explore_options.hpp"

namespace waitpoint::tools {

/// Runs the schedule that options.replay names; reports its outcome and whether it equals the recorded run. Returns the
/// exit status: 0 if it passes and is equal, else 1. BadInput for a token or a file of another target.
int replay_program(const ExploreOptions& options);

/// Instead of starting the process of that run, calls `start`, which must not return, with the descriptor of its input:
/// for a debugger that starts it.
using Start = std::function<void(const ProgramFiles& files, const RunMemory& memory, int input)>;
void replay_in(const ExploreOptions& options, const Start& start);

}  // namespace waitpoint::tools
