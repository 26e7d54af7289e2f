// SPDX-License-Identifier: BSD-3-Clause
// How a lock lends its holder urgency on a shared processor, as a value (POSIX: pthread_mutexattr_setprotocol).
#pragma once

#include <cstdint>

namespace waitpoint::kernel {

enum class LockProtocol : std::uint8_t {
  inherit,  ///< its holder is as urgent as the most urgent task that waits for it
  ceiling,  ///< its holder is as urgent as the lock declares
};

}  // namespace waitpoint::kernel
