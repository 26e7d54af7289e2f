// SPDX-License-Identifier: BSD-3-Clause
// A mask of signals for as long as a call waits: sigsuspend(), ppoll() and their kin.
#pragma once

#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {

/// A handler that ends the wait begins with it, and leaves the mask that was before.
class TemporaryMask {
 public:
  explicit TemporaryMask(SignalSet blocked) {
    Thread& thread = this_thread();
    thread.blocked_after = thread.blocked;
    thread.has_temporary_mask = true;
    set_blocked(blocked);
  }
  explicit TemporaryMask(const sigset_t* blocked)
      : TemporaryMask(blocked != nullptr ? to_set(*blocked) : this_thread().blocked) {}
  ~TemporaryMask() {
    Thread& thread = this_thread();
    if (!thread.has_temporary_mask) return;
    thread.has_temporary_mask = false;
    set_blocked(thread.blocked_after);
  }
  /// Whether a handler has run since.
  bool was_left() const { return !this_thread().has_temporary_mask; }
  TemporaryMask(const TemporaryMask&) = delete;
  TemporaryMask& operator=(const TemporaryMask&) = delete;
};

}  // namespace waitpoint::posix
