// SPDX-License-Identifier: BSD-3-Clause
// Where a thread's own variables are, as the C library lays it out: static thread-local storage, and at its end the
// thread control block, whose address is the thread pointer and the pthread_t.
//
// Where the fields are is told by what the C library exports to debuggers (_thread_db_*), and for the first few by the
// x86-64 ABI.
#pragma once

#include <cstdint>

namespace waitpoint::posix {

struct Thread;

/// The area of a new thread, its variables as they begin. Null without memory.
void* make_thread_area(int thread_id);
/// Nothing runs on it any more.
void free_thread_area(void* area);

/// The thread whose area it is; null for areas of others.
Thread*& thread_of_area(void* area);

/// The area that the calling code runs on.
void* own_thread_area();

/// The word that functions keep on the stack, to see whether it was written over.
void set_stack_guard(void* area, std::uint64_t word);

}  // namespace waitpoint::posix
