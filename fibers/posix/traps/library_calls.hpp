// SPDX-License-Identifier: BSD-3-Clause
// Waits within the C library, whose internal calls cannot be interposed: its locks, by futexes, and the reads and
// writes of a FILE*. On request (--trap-libc), these system calls of its code are trapped by seccomp, and simulated in
// the trap's handler.
//
// The runtime of OpenMP (libgomp) has futexes of its own too: if it is loaded, and raw calls are not trapped
// (raw_calls.hpp), they are always trapped, as none of its threads would ever wake another.
//
// A trap cannot be removed: started programs inherit it. It depends on the address of the C library, which is therefore
// another one there (started_programs.hpp).
#pragma once

#include <csignal>

namespace waitpoint::posix {

/// Traps those of the C library from now on.
void trap_library_calls();
/// The same for its reads from and writes to one descriptor, if that is inside, a socket or a named pipe: a FILE* of it
/// is used. Without an effect if the system does not allow it.
void trap_stream(int descriptor);
/// In a program that a process with traps has started: they apply to it, too.
void answer_inherited_traps();
/// Traps those of OpenMP's runtime, if it has been loaded in the meantime. Fast if nothing has been loaded.
void trap_open_mp();
/// True if any are trapped.
bool are_library_calls_trapped();
/// In a handler of SIGSYS: true if it was such a call, which is done then.
bool answer_library_call(const siginfo_t& information, void* context);

}  // namespace waitpoint::posix
