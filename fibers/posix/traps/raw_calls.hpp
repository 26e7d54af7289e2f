// SPDX-License-Identifier: BSD-3-Clause
// System calls that the program makes by instructions of its own, not by functions of the C library: trapped by the
// system's dispatch of such calls to a signal handler (Linux 5.11), and answered as by syscall().
//
// The C library's instructions are exempt, which costs its calls some nanoseconds. Threads of the system, and children
// of clones that share memory, have no such dispatch.
#pragma once

#include <csignal>

#include "fibers/posix/traps/library_range.hpp"

namespace waitpoint::posix {

/// In this process from now on, if the system is able to. Without an effect in a program with a sanitizer's runtime,
/// which makes calls that must be the system's.
void trap_raw_calls();
/// The same in a forked child, which does not inherit it.
void trap_raw_calls_of_child();
bool are_raw_calls_trapped();
/// From now on all calls are trapped and followed (followed_calls.hpp), those of the C library too, up to the first one
/// that cannot be undone. Without an effect if raw calls are not trapped.
void follow_all_calls(bool (*can_map_again)(LibraryRange range));
/// The same, up to the first call that a snapshot would not copy. False if raw calls are not trapped.
bool follow_calls_for_snapshots();
/// True if all calls since then can be undone, or are copied.
bool are_calls_undoable();
/// In a handler of SIGSYS: true if it was such a call, which is done then.
bool answer_raw_call(const siginfo_t& information, void* context);

}  // namespace waitpoint::posix
