// SPDX-License-Identifier: BSD-3-Clause
// Cancellation points, as listed by POSIX: the calls in which a cancelled thread exits.
#pragma once

#include "core/error.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {

/// Exits the running thread, if is_to_leave().
void leave_if_cancelled();
/// The same at the beginning of a call that does not wait; no effect before main().
inline void pass_cancellation_point() {
  if (is_simulated() && is_to_leave(this_thread())) leave_if_cancelled();
}
template <class Call>
auto at_cancellation_point(Call call) {
  pass_cancellation_point();
  return call();
}

/// Scope of a waiting call that is a cancellation point: pthread_cancel() ends the wait.
class CancellationPoint {
 public:
  /// Exits the thread if it was cancelled before.
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

  /// True if a cancellation ended the wait: the call cleans up, then calls leave_if_cancelled().
  bool was_cancelled() const { return is_to_leave(this_thread()); }
  /// As wait_on(), but does not wait if the thread was cancelled at its waitpoint.
  Wait block(kernel::Object& object, Time deadline) const {
    return was_cancelled() ? Wait::interrupted : wait_on(object, deadline);
  }
  /// Sleeps; exits the thread if it is cancelled meanwhile. False if a signal handler interrupted the sleep.
  bool wait_until(Time time) const;
};

/// Scope in which no call is a cancellation point.
class CancellationDisabled {
 public:
  CancellationDisabled() : thread_(is_simulated() ? &this_thread() : nullptr) {
    if (thread_ == nullptr) return;
    before_ = thread_->cancel_disabled;
    thread_->cancel_disabled = true;
  }
  ~CancellationDisabled() {
    if (thread_ == nullptr) return;
    WAITPOINT_CHECK(thread_ == &this_thread(), "a scope of one thread ends in another");
    thread_->cancel_disabled = before_;
  }
  CancellationDisabled(const CancellationDisabled&) = delete;
  CancellationDisabled& operator=(const CancellationDisabled&) = delete;

 private:
  Thread* thread_;
  bool before_ = false;
};

}  // namespace waitpoint::posix
