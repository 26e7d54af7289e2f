// SPDX-License-Identifier: BSD-3-Clause
// Futexes with waiters in several processes of a family: the numbers of waiters and of wake-ups across processes. A
// wake-up serves the threads of its own process first.
#pragma once

#include <cstdint>

namespace waitpoint::posix {

struct SharedFutex {
  const void* address;
  std::uint32_t waiters;  ///< not yet woken by another process
  std::uint32_t woken;    ///< by another process, and have not returned yet
};

/// Registers the running thread as a waiter, before it reads the word's value for the last time. Null if too many
/// futexes have waiters.
SharedFutex* begin_to_wait(const void* address);
/// Ends that wait; `by_own`: a thread of this process woke it. True if it was woken by this process or another.
bool end_waiting(SharedFutex& futex, bool by_own);
/// True if another process has woken a waiter: a predicate for wait_on_shared(), on a pointer to a SharedFutex pointer.
bool has_woken(const void* kept);
/// Wakes at most `most` threads of other processes; returns their number. `own` of the waiters are of this process.
std::uint32_t wake_others(const void* address, std::uint32_t most, std::uint32_t own);

}  // namespace waitpoint::posix
