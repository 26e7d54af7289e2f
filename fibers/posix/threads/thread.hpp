// SPDX-License-Identifier: BSD-3-Clause
// Making, joining and ending threads of a program; program/thread.hpp has the record of a thread.
#pragma once

#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {

/// Sets up a new thread: by `attributes` (null: the default ones) and by inheritance from the running thread. Returns
/// an error number.
int take_attributes(Thread& thread, const pthread_attr_t* attributes);

/// As pthread_timedjoin_np, with a deadline of virtual time.
int join(pthread_t id, void** result, Time deadline);
/// A thread that has ended, and that no other will join, is freed.
void let_go(Thread& thread);
/// As pthread_equal(). It takes a little time, so that a loop ends in which another thread changes what is compared.
bool are_equal(pthread_t one, pthread_t other);
/// Ends the running thread after its function: destructors of keys and thread-local variables are called.
[[noreturn]] void end_thread(Thread& thread);
/// Ends the running thread at once; no code of the program is called.
[[noreturn]] void end_running_thread();
/// Begins the thread of main(), if the process is one program: it has the area of the process's own thread. False
/// without memory.
bool begin_main_thread(Thread& thread, Program& program, kernel::Scheduler& scheduler);
/// The first thread of one of several programs; null without memory. It runs `body`.
Thread* make_main_thread(Program& program, kernel::Scheduler& scheduler, void* (*body)(void*), void* argument);
/// Ends all threads of `program` except the running one, without unwinding them.
void end_other_threads(const Program& program, kernel::Scheduler& scheduler);
/// In a child process: the forking thread becomes the first, and numbers of later threads follow its own.
void begin_again_as_first(Thread& thread);

}  // namespace waitpoint::posix
