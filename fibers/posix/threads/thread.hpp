// SPDX-License-Identifier: BSD-3-Clause
// How threads of a program are made, joined and ended (program/thread.hpp says what a thread is).
#pragma once

#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {

/// What a thread that the running one makes begins with: what `attributes` (null: the default ones) ask for, and what
/// it inherits. An error number, or 0.
int take_attributes(Thread& thread, const pthread_attr_t* attributes);

/// As pthread_timedjoin_np, with a deadline of virtual time.
int join(pthread_t id, void** result, Time deadline);
/// What is done when a thread's function is done.
[[noreturn]] void end_thread(Thread& thread);
/// The running thread ends as it is: nothing of its own is called any more.
[[noreturn]] void end_running_thread();
/// The thread that main() runs in, where the process is one program: it has the area of the process's own thread. False
/// without memory.
bool begin_main_thread(Thread& thread, Program& program, kernel::Scheduler& scheduler);
/// The first thread of one of several programs; null without memory. It runs `body`.
Thread* make_main_thread(Program& program, kernel::Scheduler& scheduler, void* (*body)(void*), void* argument);
/// Ends all threads of `program` but the running one; nothing of theirs is unwound.
void end_other_threads(const Program& program, kernel::Scheduler& scheduler);
/// In a child: the thread that called is its first, and the others' numbers follow its own.
void begin_again_as_first(Thread& thread);

}  // namespace waitpoint::posix
