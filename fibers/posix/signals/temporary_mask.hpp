// SPDX-License-Identifier: BSD-3-Clause
// A signal mask for the duration of a call: sigsuspend(), ppoll() and similar.
#pragma once

#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {

/// A handler that interrupts the wait starts with this mask and returns to the previous one.
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
  /// True if a handler has run since.
  bool was_left() const { return !this_thread().has_temporary_mask; }
  TemporaryMask(const TemporaryMask&) = delete;
  TemporaryMask& operator=(const TemporaryMask&) = delete;
};

}  // namespace waitpoint::posix
