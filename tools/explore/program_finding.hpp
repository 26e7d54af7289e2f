// SPDX-License-Identifier: BSD-3-Clause
// How a run of a program is asked for by a plan, and what it came to.
#pragma once

#include "tools/exec/run_memory.hpp"
#include "tools/explore/target.hpp"

namespace waitpoint::tools {

/// What all runs of the program have in common.
posix::Settings settings_of(const ExploreOptions& options);

/// Writes down in `memory`, before the run, what is asked of it; `profile` is of the default order.
void ask_for_run(RunMemory& memory, const ExploreOptions& options, const Plan& plan, const Target::Request& request,
                 const exploration::Profile& profile);

/// Of a run that is over: `status` is as waitpid() gives it, `output` what the program wrote last. It has passed with
/// exit status 0.
Finding finding_of_run(const RunMemory& memory, int status, const std::string& output, const Target::Request& request,
                       bool trace_too);

}  // namespace waitpoint::tools
