// SPDX-License-Identifier: BSD-3-Clause
// Where the process itself waits, in real time, with no thread of the program's running.
#pragma once

#include <atomic>

namespace waitpoint::posix {

/// While it is true, a signal that comes is only kept: whoever waits sees to it.
extern std::atomic<bool> waits_really;

class RealWait {
 public:
  RealWait() { waits_really.store(true); }
  ~RealWait() { waits_really.store(false); }
  RealWait(const RealWait&) = delete;
  RealWait& operator=(const RealWait&) = delete;
};

}  // namespace waitpoint::posix
