// SPDX-License-Identifier: BSD-3-Clause
// A lock of threads of the operating system, for a few instructions at a time. It is no mutex: it makes no call that a
// simulation stands in for, or that a program's own ThreadSanitizer sees only one half of, and signal handlers may use
// it where the interrupted thread does not hold it.
#pragma once

#include <atomic>

namespace waitpoint {

class SpinLock {
 public:
  void lock() {
    while (is_held_.test_and_set(std::memory_order_acquire)) {
    }
  }
  void unlock() { is_held_.clear(std::memory_order_release); }

 private:
  std::atomic_flag is_held_;
};

}  // namespace waitpoint
