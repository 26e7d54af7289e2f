// SPDX-License-Identifier: BSD-3-Clause
// Child processes of the program.
#pragma once

#include <sys/types.h>

namespace waitpoint::posix {

/// Before main(): makes children that are forked within the C library simulations of their own, too.
void register_fork();
/// True if the process is a host's: a copy of it would be no process of the program.
bool is_in_process();
/// Called before the running thread makes a child.
void before_child();
/// The running thread has made, or is about to make, a child whose end only the system notes: from now on its signal is
/// noticed even if no handler is set.
void await_child_in_system();
/// Forks by `real(argument)`, which is as fork(). `calls_handlers`: it calls those of pthread_atfork().
pid_t fork_by(pid_t (*real)(const void*), const void* argument, bool calls_handlers);

}  // namespace waitpoint::posix
