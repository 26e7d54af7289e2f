// SPDX-License-Identifier: BSD-3-Clause
// Waits of the process itself, in real time, while none of the program's threads runs.
#pragma once

#include <atomic>

#include "core/error.hpp"

namespace waitpoint::posix {

/// While true, incoming signals are only queued; the code that waits handles them.
extern std::atomic<bool> waits_really;

class RealWait {
 public:
  RealWait() {
    WAITPOINT_CHECK(!waits_really.load(), "a wait in real time begins within another");
    waits_really.store(true);
  }
  ~RealWait() {
    WAITPOINT_CHECK(waits_really.load(), "a wait in real time was ended by code within it");
    waits_really.store(false);
  }
  RealWait(const RealWait&) = delete;
  RealWait& operator=(const RealWait&) = delete;
};

}  // namespace waitpoint::posix
