// SPDX-License-Identifier: BSD-3-Clause
// Timed locking, in the names and semantics of the standard's timed mutexes, over a mutex's lock_before(Time).
#pragma once

#include "fibers/sync/clock.hpp"

namespace waitpoint::sync {

template <class Mutex>
class timed : public Mutex {
 public:
  using Mutex::Mutex;

  /// False if the lock is not acquired in time.
  template <class Rep, class Ratio>
  bool try_lock_for(const std::chrono::duration<Rep, Ratio>& span) {
    return this->lock_before(after(span));
  }
  template <class Clock, class Span>
  bool try_lock_until(const std::chrono::time_point<Clock, Span>& deadline) {
    return this->lock_before(until(deadline));
  }
};

}  // namespace waitpoint::sync
