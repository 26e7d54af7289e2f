// SPDX-License-Identifier: BSD-3-Clause
// A program with simulated threads, and who watches over it.
//
// The program is a process of its own, into which the library of fibers/posix is preloaded; this one waits, and says at
// the end what came of it, however it ended: what is to be known is in memory that both share.
#pragma once

#include "fibers/posix/program/record.hpp"
#include "tools/exec/exec_options.hpp"

namespace waitpoint::tools {

/// Runs the program and returns its exit status. Where a signal ended it, this process ends by the same one. BadInput
/// where it cannot be run: there is no such program, or it is linked statically.
int exec(const ExecOptions& options);

/// What a run with this seed is to do.
posix::Settings settings_of(const ExecOptions& options, std::uint64_t seed);

}  // namespace waitpoint::tools
