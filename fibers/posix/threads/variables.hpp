// SPDX-License-Identifier: BSD-3-Clause
// Destructors of a thread's variables (thread_local of C++). The C library keeps them, and with them the libraries that
// they are of; in the process of a host the layer does: their threads may end without them, and their libraries are to
// go then.
#pragma once

#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {

/// Has `function` called at the running thread's end; false without memory.
bool add_destructor(void (*function)(void*), void* argument);
/// Calls the running thread's destructors, the last one first.
void destroy_variables();
/// Frees those of a thread that ended without them.
void forget_destructors(Thread& thread);

}  // namespace waitpoint::posix
