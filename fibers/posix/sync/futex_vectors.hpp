// SPDX-License-Identifier: BSD-3-Clause
// Waiting at several futexes at once: SYS_futex_waitv.
#pragma once

#include <cstdint>

#include "fibers/kernel/task.hpp"

namespace waitpoint::posix {

struct CallWords;

/// As the system's call: which of them was woken, or -1 with errno.
long wait_for_any_futex(const CallWords& words);
/// Wakes at most so many of those that wait at this address among others; how many.
std::uint32_t wake_vectors(const void* address, std::uint32_t most);
/// In a child: nobody waits so. And: the task is not there any more.
void forget_vectors();
void forget_vector(const kernel::Task& task);

}  // namespace waitpoint::posix
