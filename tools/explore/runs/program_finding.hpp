// SPDX-License-Identifier: BSD-3-Clause
// Conversion of a plan into settings of a program's run, and of the run's end into a finding.
#pragma once

#include "tools/exec/program_process.hpp"
#include "tools/exec/run_memory.hpp"
#include "tools/explore/runs/target.hpp"

namespace waitpoint::tools {

/// The settings that all runs of the program share.
posix::Settings settings_of(const ExploreOptions& options);

/// Before a run, writes its plan into `memory`; `profile` is of the default order.
void ask_for_run(RunMemory& memory, const ProgramFiles& files, const ExploreOptions& options, const Plan& plan,
                 const WantedEvidence& wanted, const exploration::Profile& profile);

/// The choices of all its processes.
exploration::Schedule schedule_of(const posix::Record& record);

/// The finding of a finished run: `status` is as from waitpid(), `output` the program's last output. A run passes with
/// exit status 0, without a data race if `races_fail`.
Finding finding_of_run(const RunMemory& memory, int status, const std::string& output, const WantedEvidence& wanted,
                       bool races_fail);

/// Adds the run's data races in words.
void tell_races(const posix::Record& record, Finding& finding);

}  // namespace waitpoint::tools
