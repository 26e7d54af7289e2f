// SPDX-License-Identifier: BSD-3-Clause
// Waits of the process itself, in real time, while none of the program's threads runs.
#pragma once

#include <atomic>

namespace waitpoint::posix {

/// While true, incoming signals are only queued; the code that waits handles them.
extern std::atomic<bool> waits_really;

class RealWait {
 public:
  RealWait() { waits_really.store(true); }
  ~RealWait() { waits_really.store(false); }
  RealWait(const RealWait&) = delete;
  RealWait& operator=(const RealWait&) = delete;
};

}  // namespace waitpoint::posix
