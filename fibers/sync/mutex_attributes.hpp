// SPDX-License-Identifier: BSD-3-Clause
// The options of a mutex for threads that share processors, simulated or of the system: see priority_mutex.hpp.
#pragma once

#include "fibers/kernel/lock_protocol.hpp"

namespace waitpoint {

struct mutex_attributes {
  kernel::LockProtocol protocol = kernel::LockProtocol::inherit;
  int ceiling = 0;         ///< of `ceiling`: must be at least the priority of every thread that locks the mutex; a
                           ///< lower one is a misuse
  const char* label = "";  ///< shown in reports; must outlive the mutex
};

}  // namespace waitpoint
