// SPDX-License-Identifier: BSD-3-Clause
// Futexes that hold the gettid() of their owner: FUTEX_LOCK_PI and its kin, among the threads of this process. As on
// Linux, an unlocked word is zero, a bit says that there are waiters, and unlocking hands the word over to one of them.
// Priorities are not inherited: there are none.
#pragma once

#include <cstdint>

#include "core/time.hpp"

namespace waitpoint::posix {

/// 0, or -1 with errno: EDEADLK, ESRCH (no such owner), ETIMEDOUT.
long lock_owned(std::uint32_t* address, Time deadline);
/// The same, but EAGAIN instead of a wait.
long try_lock_owned(std::uint32_t* address);
/// EPERM if the running thread does not own it.
long unlock_owned(std::uint32_t* address);

}  // namespace waitpoint::posix
