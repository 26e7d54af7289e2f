// SPDX-License-Identifier: BSD-3-Clause
// Waiting at several futexes at once: SYS_futex_waitv.
#pragma once

#include <cstdint>

#include "fibers/kernel/task.hpp"

namespace waitpoint::posix {

struct CallWords;

/// As the system call: the index of the word that was woken, or -1 with errno.
long wait_for_any_futex(const CallWords& words);
/// Wakes at most `most` threads that wait at this address among others; returns their number.
std::uint32_t wake_vectors(const void* address, std::uint32_t most);
/// In a child process: drops all waiters.
void forget_vectors();
/// Drops the waiter of a task that has ended.
void forget_vector(const kernel::Task& task);

}  // namespace waitpoint::posix
