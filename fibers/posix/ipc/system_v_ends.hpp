// SPDX-License-Identifier: BSD-3-Clause
// Cleaning up System V's objects when threads, programs and runs end.
#pragma once

#include <sys/types.h>

#include "fibers/posix/program/program_state.hpp"

namespace waitpoint::posix::system_v {

/// Drops the waiter of a task that has ended.
void forget_waiter(const kernel::Task& task);
void forget_semaphore_waiter(const kernel::Task& task);
void forget_message_waiter(const kernel::Task& task);

/// Reverts the program's SEM_UNDO operations.
void undo_semaphores_of(const Program& program);

/// In a child process: it has its parent's attachments.
void inherit_memory(pid_t parent);

/// Frees all objects when their last user has ended; identifiers start again.
void forget_memory();
void forget_messages();
void forget_semaphores();

}  // namespace waitpoint::posix::system_v
