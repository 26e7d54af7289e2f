// SPDX-License-Identifier: BSD-3-Clause
// The priority protocol of a lock on a shared processor (POSIX: pthread_mutexattr_setprotocol).
#pragma once

#include <cstdint>

namespace waitpoint::kernel {

enum class LockProtocol : std::uint8_t {
  inherit,  ///< the holder has at least the priority of the most urgent waiter
  ceiling,  ///< the holder has at least the priority that the lock declares
};

}  // namespace waitpoint::kernel
