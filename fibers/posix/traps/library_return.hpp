// SPDX-License-Identifier: BSD-3-Clause
// A callback when a call of the C library returns to the program.
//
// Some actions are not allowed within the C library, as it may hold locks of its own. They wait until it has returned:
// the return address of its outermost function is replaced by that of a function of ours.
#pragma once

#include <cstdint>

#include "fibers/posix/traps/library_range.hpp"

namespace waitpoint::posix {

/// Calls `then` in the running thread when the call of `library` that was interrupted at `interrupted` has returned to
/// code for which `is_of_program` is true. To be called by the handler of the interrupting signal. False, without any
/// effect, if other code is in between (a callback that is pending already, for one), or if the stack cannot be
/// unwound.
///
/// `then` is not called if the call never returns: longjmp() out of it, or an exception of a function that it calls.
bool call_after_return(std::uintptr_t interrupted, const LibraryRange& library, bool (*is_of_program)(std::uintptr_t),
                       void (*then)());

}  // namespace waitpoint::posix
