// SPDX-License-Identifier: BSD-3-Clause
// Child processes of the program.
#pragma once

#include <sys/types.h>

namespace waitpoint::posix {

/// Before main(): makes children that are forked within the C library simulations of their own, too.
void register_fork();
/// True if the process is a host's: a copy of it would be no process of the program.
bool is_guest();
/// Called before the running thread makes a child.
void before_child();
/// Forks by `real(argument)`, which is as fork(). `calls_handlers`: it calls those of pthread_atfork().
pid_t fork_by(pid_t (*real)(const void*), const void* argument, bool calls_handlers);

}  // namespace waitpoint::posix
