// SPDX-License-Identifier: BSD-3-Clause
// What becomes of System V's objects when threads, programs and runs end.
#pragma once

#include <sys/types.h>

#include "fibers/posix/program/program_state.hpp"

namespace waitpoint::posix::system_v {

/// The task is not there any more: it waits for nothing.
void forget_waiter(const kernel::Task& task);
void forget_semaphore_waiter(const kernel::Task& task);
void forget_message_waiter(const kernel::Task& task);

/// Takes back what the program did to semaphores with SEM_UNDO.
void undo_semaphores_of(const Program& program);

/// In a child: what its parent had attached, it has too.
void inherit_memory(pid_t parent);

/// There are none any more, and identifiers begin anew: nobody is left who uses any.
void forget_memory();
void forget_messages();
void forget_semaphores();

}  // namespace waitpoint::posix::system_v
