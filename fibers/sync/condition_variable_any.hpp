// SPDX-License-Identifier: BSD-3-Clause
// Condition variable over any lock with lock() and unlock(), in the names and semantics of std::condition_variable_any.
//
// A waiter enters the list before it unlocks, so that a notification between its unlock and its sleep is not lost.
// Different tasks may wait with different locks. Spurious wake-ups occur only where exploration chooses one. A stop
// request ends the waits with its token, and no others.
#pragma once

#include <condition_variable>

#include "fibers/sync/clock.hpp"
#include "fibers/sync/ignored_accesses.hpp"
#include "fibers/sync/object.hpp"
#include "fibers/sync/report/misuse.hpp"
#include "fibers/sync/stop_token.hpp"

namespace waitpoint {

using std::cv_status;

class condition_variable_any {
 public:
  constexpr condition_variable_any() = default;
  explicit constexpr condition_variable_any(const char* label) : object_("condition variable", label) {}
  ~condition_variable_any() { sync::drain_woken_waiters(object_); }
  condition_variable_any(const condition_variable_any&) = delete;
  condition_variable_any& operator=(const condition_variable_any&) = delete;

  void notify_one() {
    if (sync::before_releasing(kernel::Operation::notify_one, object_) && has_users()) notify_a_waiter();
  }
  void notify_all();

  template <class Lock>
  void wait(Lock& lock) {
    wait_before(lock, Time::max());
  }
  template <class Lock, class Predicate>
  void wait(Lock& lock, Predicate ready) {
    while (!ready()) wait(lock);
  }

  template <class Lock, class Clock, class Span>
  cv_status wait_until(Lock& lock, const std::chrono::time_point<Clock, Span>& deadline) {
    return wait_before(lock, sync::until(deadline)) ? cv_status::no_timeout : cv_status::timeout;
  }
  template <class Lock, class Clock, class Span, class Predicate>
  bool wait_until(Lock& lock, const std::chrono::time_point<Clock, Span>& deadline, Predicate ready) {
    return wait_before(lock, sync::until(deadline), ready);
  }

  template <class Lock, class Rep, class Ratio>
  cv_status wait_for(Lock& lock, const std::chrono::duration<Rep, Ratio>& span) {
    return wait_before(lock, sync::after(span)) ? cv_status::no_timeout : cv_status::timeout;
  }
  template <class Lock, class Rep, class Ratio, class Predicate>
  bool wait_for(Lock& lock, const std::chrono::duration<Rep, Ratio>& span, Predicate ready) {
    return wait_before(lock, sync::after(span), ready);
  }

  /// Each returns ready() once that is true, a stop is requested through `token`, or the deadline has passed.
  template <class Lock, class Predicate>
  bool wait(Lock& lock, stop_token token, Predicate ready) {
    return wait_before(lock, std::move(token), Time::max(), ready);
  }
  template <class Lock, class Clock, class Span, class Predicate>
  bool wait_until(Lock& lock, stop_token token, const std::chrono::time_point<Clock, Span>& deadline, Predicate ready) {
    return wait_before(lock, std::move(token), sync::until(deadline), ready);
  }
  template <class Lock, class Rep, class Ratio, class Predicate>
  bool wait_for(Lock& lock, stop_token token, const std::chrono::duration<Rep, Ratio>& span, Predicate ready) {
    return wait_before(lock, std::move(token), sync::after(span), ready);
  }

 private:
  struct Stop;
  // One wait, in the waiter's frame.
  struct Waiter {
    Stop* stop = nullptr;
    kernel::Task* task = nullptr;
    Waiter* next = nullptr;
    bool blocked = false;   // false: still between its unlock and its sleep
    bool notified = false;  // and out of the list
  };
  // Links the waits of one call to a stop request.
  struct Stop {
    bool is_asked() const {
      const sync::IgnoredAccesses ignored_accesses;
      return requested;
    }
    // A switch point of its own: it takes the waiter from other notifications.
    void operator()() {
      request();
      if (sync::before_releasing(kernel::Operation::notify_all, condition.object_)) wake();
    }
    void request() {
      const sync::IgnoredAccesses ignored_accesses;
      requested = true;
    }
    void wake() {
      const sync::IgnoredAccesses ignored_accesses;
      if (waiter != nullptr && !waiter->notified) condition.notify(*waiter);
    }
    condition_variable_any& condition;
    Waiter* waiter = nullptr;  // in the list, or just removed
    bool requested = false;
  };
  // Relocks however the wait ends. Passes Unwind on: lock() throws it only if no exception is in flight.
  template <class Lock>
  struct Relock {
    ~Relock() noexcept(false) { lock.lock(); }
    Lock& lock;
  };

  // False if the deadline came first. The lock is held again in both cases.
  template <class Lock>
  bool wait_before(Lock& lock, Time deadline, Stop* stop = nullptr) {
    Waiter self{stop};
    if (!enlist(self)) return false;
    if (stop != nullptr && stop->is_asked()) {  // requested before there was a waiter to wake
      leave(self);
      return true;
    }
    try {
      lock.unlock();
    } catch (...) {
      leave(self);
      throw;
    }
    const Relock<Lock> relock{lock};
    return sleep(self, deadline);
  }
  template <class Lock, class Predicate>
  bool wait_before(Lock& lock, Time deadline, Predicate ready) {
    while (!ready())
      if (!wait_before(lock, deadline)) return ready();
    return true;
  }
  template <class Lock, class Predicate>
  bool wait_before(Lock& lock, stop_token token, Time deadline, Predicate ready) {
    Stop stop{*this};
    const stop_callback<Stop&> wake(std::move(token), stop);
    while (!stop.is_asked()) {
      if (ready()) return true;
      if (!wait_before(lock, deadline, &stop)) break;
    }
    return ready();
  }

  // `users` counts the waiters in the list or woken from it. If it is 0, as in a new run, the list is empty.
  bool has_users() const {
    const sync::IgnoredAccesses ignored_accesses;
    return object_.users != 0;
  }
  bool enlist(Waiter& waiter);
  bool sleep(Waiter& waiter, Time deadline);
  void leave(Waiter& waiter);
  void remove_waiter(Waiter& waiter);
  void notify(Waiter& waiter);
  void notify_a_waiter();

  sync::Object object_{"condition variable"};
  Waiter* first_ = nullptr;
  Waiter* last_ = nullptr;
};

}  // namespace waitpoint
