// SPDX-License-Identifier: BSD-3-Clause
// Condition variable, in the names and semantics of std::condition_variable, over waitpoint::mutex.
//
// Releasing the mutex and starting to wait are one atomic step. Spurious wake-ups occur only where exploration chooses
// one. It is a misuse to wait without the mutex, to wait with a mutex other than the present waiters', or to destroy it
// while tasks wait; as in the standard, it may be destroyed as soon as all waiters are notified.
#pragma once

#include <condition_variable>
#include <mutex>

#include "fibers/sync/mutex.hpp"
#include "fibers/sync/object.hpp"

namespace waitpoint {

using std::cv_status;

class condition_variable {
 public:
  constexpr condition_variable() = default;
  explicit constexpr condition_variable(const char* label) : object_("condition variable", label) {}
  ~condition_variable() { sync::drain_woken_waiters(object_); }
  condition_variable(const condition_variable&) = delete;
  condition_variable& operator=(const condition_variable&) = delete;

  void notify_one() {
    if (sync::before_releasing(kernel::Operation::notify_one, object_) && sync::wake_one(object_) != nullptr)
      kernel::note_transfer();
  }
  void notify_all();

  [[gnu::always_inline]] void wait(std::unique_lock<mutex>& lock) { wait_before(lock, Time::max()); }
  template <class Predicate>
  void wait(std::unique_lock<mutex>& lock, Predicate ready) {
    while (!ready()) wait(lock);
  }

  template <class Clock, class Span>
  cv_status wait_until(std::unique_lock<mutex>& lock, const std::chrono::time_point<Clock, Span>& deadline) {
    return wait_before(lock, sync::until(deadline)) ? cv_status::no_timeout : cv_status::timeout;
  }
  template <class Clock, class Span, class Predicate>
  bool wait_until(std::unique_lock<mutex>& lock, const std::chrono::time_point<Clock, Span>& deadline,
                  Predicate ready) {
    return wait_before(lock, sync::until(deadline), ready);
  }

  template <class Rep, class Ratio>
  cv_status wait_for(std::unique_lock<mutex>& lock, const std::chrono::duration<Rep, Ratio>& span) {
    return wait_before(lock, sync::after(span)) ? cv_status::no_timeout : cv_status::timeout;
  }
  template <class Rep, class Ratio, class Predicate>
  bool wait_for(std::unique_lock<mutex>& lock, const std::chrono::duration<Rep, Ratio>& span, Predicate ready) {
    return wait_before(lock, sync::after(span), ready);
  }

 private:
  // False if the deadline came first. The lock is held again in both cases.
  [[gnu::always_inline]] bool wait_before(std::unique_lock<mutex>& lock, Time deadline) {
    const Start start = start_waiting(lock);
    if (start == Start::over) return false;
    const bool woken = start == Start::spurious || sync::block(object_, deadline);
    lock.mutex()->lock();
    return woken;
  }
  enum class Start { waits, spurious, over };
  Start start_waiting(std::unique_lock<mutex>& lock);
  template <class Predicate>
  bool wait_before(std::unique_lock<mutex>& lock, Time deadline, Predicate ready) {
    while (!ready())
      if (!wait_before(lock, deadline)) return ready();
    return true;
  }

  sync::Object object_{"condition variable"};
  const mutex* mutex_ = nullptr;  // the waiters' mutex
};

}  // namespace waitpoint
