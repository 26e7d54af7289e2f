// SPDX-License-Identifier: BSD-3-Clause
// Mutual exclusion, in the names and semantics of std::mutex and std::timed_mutex.
//
// An unlock with waiters hands the mutex to one of them: the first in the default order, the chooser's choice else.
// Locking a mutex that the caller holds is a deadlock of one, and reported as such. Trying to, which the standard
// leaves undefined, is a bug, and so are unlocking what one does not hold, ending while one holds it, and destroying it
// while it is held or waited for.
#pragma once

#include "fibers/sync/clock.hpp"
#include "fibers/sync/mutex_core.hpp"

namespace waitpoint {

class condition_variable;

class mutex {
 public:
  constexpr mutex() = default;
  /// `label` is shown in reports; it must outlive the mutex.
  explicit constexpr mutex(const char* label) : core_("mutex", label) {}
  mutex(const mutex&) = delete;
  mutex& operator=(const mutex&) = delete;

  void lock() {
    if (sync::before_blocking(kernel::Operation::lock, core_.object())) core_.acquire(Time::max());
  }
  bool try_lock() { return lock_before(sync::long_past); }
  void unlock() {
    if (sync::before_releasing(kernel::Operation::unlock, core_.object())) core_.release();
  }

 protected:
  bool lock_before(Time deadline);

 private:
  friend class condition_variable;

  sync::MutexCore core_{"mutex", ""};
};

class timed_mutex : public mutex {
 public:
  using mutex::mutex;

  template <class Rep, class Ratio>
  bool try_lock_for(const std::chrono::duration<Rep, Ratio>& span) {
    return lock_before(sync::after(span));
  }
  template <class Clock, class Span>
  bool try_lock_until(const std::chrono::time_point<Clock, Span>& deadline) {
    return lock_before(sync::until(deadline));
  }
};

}  // namespace waitpoint
