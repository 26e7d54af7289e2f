// SPDX-License-Identifier: BSD-3-Clause
// Cancellation points: calls in which a thread that is cancelled leaves, as POSIX lists them.
#pragma once

#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {

/// Whether `thread` was cancelled, does not forbid it, and is not on its way out.
inline bool is_to_leave(const Thread& thread) { return thread.cancelled && !thread.cancel_disabled && !thread.exiting; }

/// Leaves the running thread, if it was cancelled and does not forbid it.
void leave_if_cancelled();
/// The same at the beginning of a call that does not wait; nothing before main().
inline void pass_cancellation_point() {
  if (is_simulated() && is_to_leave(this_thread())) leave_if_cancelled();
}
template <class Call>
auto at_cancellation_point(Call call) {
  pass_cancellation_point();
  return call();
}

/// A call that waits and is a cancellation point, while it lasts: pthread_cancel() ends the wait.
class CancellationPoint {
 public:
  /// Leaves the thread if it was cancelled before.
  CancellationPoint() {
    if (!is_simulated()) return;
    leave_if_cancelled();
    this_thread().in_cancellation_point = true;
  }
  ~CancellationPoint() {
    if (is_simulated()) this_thread().in_cancellation_point = false;
  }
  CancellationPoint(const CancellationPoint&) = delete;
  CancellationPoint& operator=(const CancellationPoint&) = delete;

  /// Whether the wait that has just ended was ended by a cancellation: what the call has to put right comes first, then
  /// leave_if_cancelled().
  bool was_cancelled() const { return is_to_leave(this_thread()); }
  /// As wait_on(), but does not begin to wait if the thread was cancelled at its waitpoint.
  Wait block(kernel::Object& object, Time deadline) const {
    return was_cancelled() ? Wait::interrupted : wait_on(object, deadline);
  }
  /// Sleeps, and leaves the thread if it is cancelled meanwhile; false if a signal's handler ended it.
  bool wait_until(Time time) const;
};

/// While it lasts, a call is no cancellation point, whatever it does.
class CancellationDisabled {
 public:
  CancellationDisabled() : thread_(is_simulated() ? &this_thread() : nullptr) {
    if (thread_ == nullptr) return;
    before_ = thread_->cancel_disabled;
    thread_->cancel_disabled = true;
  }
  ~CancellationDisabled() {
    if (thread_ != nullptr) thread_->cancel_disabled = before_;
  }
  CancellationDisabled(const CancellationDisabled&) = delete;
  CancellationDisabled& operator=(const CancellationDisabled&) = delete;

 private:
  Thread* thread_;
  bool before_ = false;
};

}  // namespace waitpoint::posix
