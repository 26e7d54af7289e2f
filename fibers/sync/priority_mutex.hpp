// SPDX-License-Identifier: BSD-3-Clause
// A mutex for threads that share processors, in the shape of std::timed_mutex and with the protocols of POSIX
// (pthread_mutexattr_setprotocol), which bound how long a more urgent thread waits for a less urgent one:
//
//   inherit   its holder is as urgent as the most urgent thread that waits for it, also along a chain of such mutexes,
//             until that one gives up waiting (PTHREAD_PRIO_INHERIT)
//   ceiling   its holder is as urgent as the declared ceiling, as soon as it holds it (PTHREAD_PRIO_PROTECT)
//
// An unlock hands it to the most urgent waiter, of these to the first, in every order: there is no choice. Misuse is
// what it is of a mutex.
#pragma once

#include "fibers/kernel/processor.hpp"
#include "fibers/sync/clock.hpp"
#include "fibers/sync/misuse.hpp"
#include "fibers/sync/mutex_attributes.hpp"

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
  /// By its holder only.
  void unlock();

 private:
  bool lock_before(Time deadline);
  bool acquire(Time deadline);

  sync::Object object_;
  kernel::PriorityLock lock_;
};

}  // namespace waitpoint
