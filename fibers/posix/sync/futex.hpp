// SPDX-License-Identifier: BSD-3-Clause
// Futexes: std::atomic::wait, latches, futures, guards of static variables and many libraries use them.
#pragma once

#include <cstdint>
#include <ctime>

namespace waitpoint::posix {

/// As the system call.
long futex(std::uint32_t* address, int operation, std::uint32_t value, const timespec* timeout, std::uint32_t* second,
           std::uint32_t third);

}  // namespace waitpoint::posix
