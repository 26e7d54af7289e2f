// SPDX-License-Identifier: BSD-3-Clause
// Where a call of the C library returns to the program.
//
// What may not be done within the C library, which may hold locks of its own there, waits until it has returned: the
// return address of the outermost of its functions is replaced by that of a function of ours.
#pragma once

#include <cstdint>

#include "fibers/posix/traps/library_range.hpp"

namespace waitpoint::posix {

/// Does `then` in the running thread when what was interrupted at that address, in `library`, has returned to what
/// `is_of_program`. To be called by the handler of the signal that interrupted it. False, and nothing is done, if
/// anything else is in between (it was asked for already, for one), or how to unwind is not known.
///
/// It is not done if the call never returns: longjmp() out of it, or an exception of a function that it calls.
bool call_after_return(std::uintptr_t interrupted, const LibraryRange& library, bool (*is_of_program)(std::uintptr_t),
                       void (*then)());

}  // namespace waitpoint::posix
