// SPDX-License-Identifier: BSD-3-Clause
// A mutex for threads that share processors, with the interface of std::timed_mutex and the protocols of POSIX
// (pthread_mutexattr_setprotocol), which bound priority inversion:
//
//   inherit   the holder inherits the priority of its most urgent waiter, also along a chain of such mutexes, until
//   that
//             waiter gives up (PTHREAD_PRIO_INHERIT)
//   ceiling   the holder has the declared ceiling as its priority from the lock on (PTHREAD_PRIO_PROTECT)
//
// An unlock hands it to the most urgent waiter, the first of equals, in every order: there is no choice. Misuse as of
// mutex.
#pragma once

#include "fibers/kernel/processor.hpp"
#include "fibers/sync/clock.hpp"
#include "fibers/sync/mutex_attributes.hpp"
#include "fibers/sync/object.hpp"
#include "fibers/sync/report/misuse.hpp"

namespace waitpoint {

class priority_mutex {
 public:
  explicit priority_mutex(const mutex_attributes& attributes = {})
      : object_("mutex", attributes.label), lock_{object_, attributes.protocol, attributes.ceiling} {}
  /// `label` is shown in reports; it must outlive the mutex.
  explicit priority_mutex(const char* label) : priority_mutex(mutex_attributes{.label = label}) {}
  priority_mutex(const priority_mutex&) = delete;
  priority_mutex& operator=(const priority_mutex&) = delete;

  void lock();
  bool try_lock() { return lock_before(sync::long_past); }
  template <class Rep, class Ratio>
  bool try_lock_for(const std::chrono::duration<Rep, Ratio>& span) {
    return lock_before(sync::after(span));
  }
  template <class Clock, class Span>
  bool try_lock_until(const std::chrono::time_point<Clock, Span>& deadline) {
    return lock_before(sync::until(deadline));
  }
  /// Only by its holder.
  void unlock();

 private:
  bool lock_before(Time deadline);
  bool acquire(Time deadline);

  sync::Object object_;
  kernel::PriorityLock lock_;
};

}  // namespace waitpoint
