// SPDX-License-Identifier: BSD-3-Clause
// Mutual exclusion, in the names and semantics of std::mutex and std::timed_mutex.
//
// An unlock with waiters hands the mutex to one of them: the first in the default order, else the chooser's choice.
// Relocking a mutex that the caller holds is reported as a self-deadlock. Undefined behaviour in the standard is a
// misuse here: try_lock() by the holder, unlock() by another task, ending a thread that holds the mutex, destroying it
// while it is held or waited for.
#pragma once

#include "fibers/sync/mutex_core.hpp"
#include "fibers/sync/timed.hpp"

namespace waitpoint {

class condition_variable;

class mutex {
 public:
  constexpr mutex() = default;
  /// `label` is shown in reports; it must outlive the mutex.
  explicit constexpr mutex(const char* label) : core_("mutex", label) {}
  mutex(const mutex&) = delete;
  mutex& operator=(const mutex&) = delete;

  [[gnu::always_inline]] void lock() {
    if (sync::before_blocking(kernel::Operation::lock, core_.object())) core_.acquire(Time::max());
  }
  bool try_lock() { return lock_before(sync::long_past); }
  [[gnu::always_inline]] void unlock() {
    if (sync::before_releasing(kernel::Operation::unlock, core_.object())) core_.release();
  }

 protected:
  bool lock_before(Time deadline);

 private:
  friend class condition_variable;

  sync::MutexCore core_{"mutex", ""};
};

using timed_mutex = sync::timed<mutex>;

}  // namespace waitpoint
