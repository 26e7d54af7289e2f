// SPDX-License-Identifier: BSD-3-Clause
// The system calls of a run that can be undone: those that change nothing but the process's memory, or what is known
// here. Each is made in the handler that has trapped it (raw_calls.hpp).
#pragma once

#include <ucontext.h>

#include "fibers/posix/base/system_call_words.hpp"
#include "fibers/posix/traps/library_range.hpp"

namespace waitpoint::posix {

/// Before the first call: notes the state that they may change. `can_map_again` is true for a range of memory that is
/// anonymous, private and readable and writable, whose contents will be put back.
void begin_to_follow_calls(bool (*can_map_again)(LibraryRange range));
/// The calls are not to be undone, but a fork of the process must copy all that they change: they are such calls, or
/// use descriptors that the run has opened, which must be closed at the fork.
void begin_to_follow_calls_for_snapshots();
/// Makes the call, and puts its result into the context. False, without having made it, if it could not be undone
/// or copied.
bool follow_call(long number, const CallWords& words, ucontext_t& context);
/// True if a call since then may have taken pages away from memory that was mapped before.
bool have_calls_discarded();
/// Undoes the calls, apart from the contents of memory; on no memory that was mapped since.
void undo_calls();

/// The instructions by which the C library's handlers of signals return.
LibraryRange return_from_handlers();

}  // namespace waitpoint::posix
