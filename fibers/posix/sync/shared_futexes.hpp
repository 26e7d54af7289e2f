// SPDX-License-Identifier: BSD-3-Clause
// Futexes at which threads of several processes of a family wait: how many, and how many of those of other processes
// were woken. Who wakes serves the threads of its own process first.
#pragma once

#include <cstdint>

namespace waitpoint::posix {

struct SharedFutex {
  const void* address;
  std::uint32_t waiters;  ///< not woken yet by another process
  std::uint32_t woken;    ///< by another process, and still on their way
};

/// The running thread is about to wait; null where too many futexes are waited for. To be told before it looks at the
/// word's value for the last time.
SharedFutex* begin_to_wait(const void* address);
/// It has waited: whether another process has woken it, or one of its own did.
bool end_waiting(SharedFutex& futex, bool by_own);
/// Whether another process has woken somebody: a predicate for wait_on_shared(), of where the futex is kept.
bool has_woken(const void* kept);
/// Wakes at most so many threads of other processes, beside the `own` that wait in this one; how many.
std::uint32_t wake_others(const void* address, std::uint32_t most, std::uint32_t own);

}  // namespace waitpoint::posix
