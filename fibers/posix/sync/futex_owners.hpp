// SPDX-License-Identifier: BSD-3-Clause
// Futexes that hold the gettid() of their owner: FUTEX_LOCK_PI and its kin, among the threads of this process. As on
// Linux, an unlocked word is zero, a bit says that somebody waits, and who unlocks hands over. There are no priorities
// to be inherited.
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
