// SPDX-License-Identifier: BSD-3-Clause
// What the C library waits for within itself, where no name can be put before its own: its locks, by futexes, and what
// a FILE* reads and writes. If it was asked for, these system calls of its code are traps, in whose handler they are
// simulated.
//
// The runtime of OpenMP (libgomp) waits by futexes of its own too: where it is loaded, these are traps unasked, as no
// thread of it would ever wake another.
//
// A trap cannot be given up: programs that are started inherit it. It goes by the place of the C library, which is to
// be another there (started_programs.hpp).
#pragma once

#include <csignal>

namespace waitpoint::posix {

/// From now on, those of the C library.
void trap_library_calls();
/// Those of OpenMP's runtime, if it has been loaded meanwhile. Quick where nothing has.
void trap_open_mp();
/// Whether any are.
bool are_library_calls_trapped();
/// In a handler of SIGSYS: whether it was such a call, and was made.
bool answer_library_call(const siginfo_t& information, void* context);

}  // namespace waitpoint::posix
