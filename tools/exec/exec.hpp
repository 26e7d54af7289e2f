// SPDX-License-Identifier: BSD-3-Clause
// Runs a program with simulated threads, and supervises it.
//
// The program is a separate process with the library of fibers/posix preloaded; this one waits for it and reports its
// result, however it ended, from shared memory.
#pragma once

#include "fibers/posix/program/record.hpp"
#include "tools/exec/exec_options.hpp"

namespace waitpoint::tools {

/// Runs the program and returns its exit status. If a signal ended the program, this process ends by the same one.
/// BadInput for a program that cannot be run: missing or linked statically.
int exec(const ExecOptions& options);

/// The settings of a run with this seed.
posix::Settings settings_of(const ExecOptions& options, std::uint64_t seed);

}  // namespace waitpoint::tools
