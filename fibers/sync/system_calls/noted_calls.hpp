// SPDX-License-Identifier: BSD-3-Clause
// The notes that functions in the C library's place make of their calls (system_calls.hpp). `place` is the return
// address: each place is noted once.
#pragma once

namespace waitpoint::sync {

/// True in a task of the thread that simulates, unless its calls are those of a robot's program.
bool is_in_task();
/// In a task, a module's constructor or destructor: the call starts what runs in real time.
void note_start(const char* function, const void* place);
/// pthread_create(): outside of the run, too, for tell_threads_outside().
void note_thread(const void* place);
/// In a task: the call waits in real time. In a constructor or destructor, it holds up nothing.
void note_wait(const char* function, const void* place);

}  // namespace waitpoint::sync
