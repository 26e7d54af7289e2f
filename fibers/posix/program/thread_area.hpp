// SPDX-License-Identifier: BSD-3-Clause
// A thread's area, as the C library lays it out: static thread-local storage followed by the thread control block
// (TCB). The address of the TCB is the thread pointer and the pthread_t.
//
// Offsets of members are those that the C library exports to debuggers (_thread_db_*); the x86-64 ABI fixes the first.
#pragma once

#include <cstdint>

namespace waitpoint::posix {

struct Thread;

/// The area of a new thread, with initialised variables. Null without memory.
void* make_thread_area(int thread_id);
/// No code may run on it.
void free_thread_area(void* area);

/// The thread that owns the area; null for areas of the C library's own threads.
Thread*& thread_of_area(void* area);

/// The area that the calling code runs on.
void* own_thread_area();

/// Sets the canary by which functions detect an overrun of their stack frame.
void set_stack_guard(void* area, std::uint64_t word);

}  // namespace waitpoint::posix
