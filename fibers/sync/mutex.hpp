// SPDX-License-Identifier: BSD-3-Clause
// Mutual exclusion, in the names and semantics of std::mutex and std::timed_mutex.
//
// An unlock with waiters hands the mutex to one of them: the first in the default order, the chooser's choice else.
// Locking a mutex that the caller holds is a deadlock of one, and reported as such; unlocking one that it does not hold
// is a bug.
#pragma once

#include "fibers/sync/clock.hpp"

namespace waitpoint {

class condition_variable;

class mutex {
 public:
  constexpr mutex() = default;
  /// `label` is shown in reports; it must outlive the mutex.
  explicit constexpr mutex(const char* label) : object_("mutex", label) {}
  mutex(const mutex&) = delete;
  mutex& operator=(const mutex&) = delete;

  void lock() {
    sync::before_blocking(kernel::Operation::lock, object_);
    acquire(Time::max());
  }
  bool try_lock() {
    sync::before_blocking(kernel::Operation::try_lock, object_);
    if (object_.owner != nullptr) return false;
    object_.owner = kernel::running;
    return true;
  }
  void unlock() {
    if (sync::before_releasing(kernel::Operation::unlock, object_)) release();
  }

 protected:
  // True once the caller holds the mutex; false if the deadline came first.
  bool acquire(Time deadline);
  kernel::Object& object() { return object_; }

 private:
  friend class condition_variable;
  void release();

  kernel::Object object_{"mutex"};
};

class timed_mutex : public mutex {
 public:
  using mutex::mutex;

  template <class Rep, class Ratio>
  bool try_lock_for(const std::chrono::duration<Rep, Ratio>& span) {
    return lock_before(sync::after(span));
  }
  bool try_lock_until(steady_clock::time_point deadline) { return lock_before(to_time(deadline)); }

 private:
  bool lock_before(Time deadline);
};

}  // namespace waitpoint
