// SPDX-License-Identifier: BSD-3-Clause
// Processes that the program makes.
#pragma once

#include <sys/types.h>

namespace waitpoint::posix {

/// Before main(): whoever forks within the C library too leaves a child that is a simulation of its own.
void register_fork();
/// Whether the process is a host's: a copy of that would be no process of the program's.
bool is_guest();
/// The running thread is about to make one.
void before_child();
/// It forks, by `real(argument)`, which is as fork(): with the handlers of pthread_atfork() or without.
pid_t fork_by(pid_t (*real)(const void*), const void* argument, bool calls_handlers);

}  // namespace waitpoint::posix
