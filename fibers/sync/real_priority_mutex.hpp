// SPDX-License-Identifier: BSD-3-Clause
// priority_mutex for OS threads: a POSIX mutex with priority inheritance, whatever protocol is requested. (Ceilings are
// on the scale of simulated processors; the system's scale differs and exists for real-time threads only.)
#pragma once

#include <pthread.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <type_traits>

#include "fibers/sync/mutex_attributes.hpp"

namespace waitpoint::threads {

class priority_mutex {
 public:
  explicit priority_mutex(const mutex_attributes& = {}) {
    pthread_mutexattr_t how;
    pthread_mutexattr_init(&how);
    pthread_mutexattr_setprotocol(&how, PTHREAD_PRIO_INHERIT);
    const int error = pthread_mutex_init(&mutex_, &how);
    pthread_mutexattr_destroy(&how);
    expect(error);
  }
  explicit priority_mutex(const char*) : priority_mutex() {}
  ~priority_mutex() { pthread_mutex_destroy(&mutex_); }
  priority_mutex(const priority_mutex&) = delete;
  priority_mutex& operator=(const priority_mutex&) = delete;

  void lock() { expect(pthread_mutex_lock(&mutex_)); }
  bool try_lock() { return had(pthread_mutex_trylock(&mutex_)); }
  template <class Rep, class Ratio>
  bool try_lock_for(const std::chrono::duration<Rep, Ratio>& span) {
    // With inheritance, timed waits work on CLOCK_REALTIME only.
    return try_lock_until(std::chrono::system_clock::now() + std::chrono::ceil<std::chrono::nanoseconds>(span));
  }
  template <class Clock, class Span>
  bool try_lock_until(const std::chrono::time_point<Clock, Span>& deadline) {
    if constexpr (std::is_same_v<Clock, std::chrono::system_clock>) {
      const auto seconds = std::chrono::floor<std::chrono::seconds>(deadline);
      const std::chrono::nanoseconds rest = deadline - seconds;
      const timespec date{seconds.time_since_epoch().count(), static_cast<long>(rest.count())};
      return had(pthread_mutex_timedlock(&mutex_, &date));
    } else {
      return try_lock_for(deadline - Clock::now());
    }
  }
  void unlock() { pthread_mutex_unlock(&mutex_); }

 private:
  static void expect(int error) {
    if (error != 0) throw std::system_error(error, std::generic_category());
  }
  static bool had(int error) {
    if (error != EBUSY && error != ETIMEDOUT) expect(error);
    return error == 0;
  }

  pthread_mutex_t mutex_;
};

}  // namespace waitpoint::threads
