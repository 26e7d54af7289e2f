// SPDX-License-Identifier: BSD-3-Clause
// What the C library waits for within itself, where no name can be put before its own: its locks, by futexes, and what
// a FILE* reads and writes. If it was asked for, these system calls of its code are traps, in whose handler they are
// simulated.
//
// A trap cannot be given up: programs that are started inherit it. It goes by the place of the C library, which is to
// be another there (started_programs.hpp).
#pragma once

#include <csignal>

namespace waitpoint::posix {

/// From now on.
void trap_library_calls();
/// In a handler of SIGSYS: whether it was such a call, and was made.
bool answer_library_call(const siginfo_t& information, void* context);

}  // namespace waitpoint::posix
