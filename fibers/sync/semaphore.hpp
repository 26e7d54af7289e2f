// SPDX-License-Identifier: BSD-3-Clause
// Counting semaphore, in the names and semantics of std::counting_semaphore.
//
// A release with waiters hands a unit to one of them directly. After a run, the semaphore has its initial count again.
// An initial count out of range, a release beyond the greatest count and destroying a semaphore while tasks wait for it
// are bugs.
#pragma once

#include <cstddef>

#include "fibers/sync/blocking.hpp"
#include "fibers/sync/clock.hpp"
#include "fibers/sync/object.hpp"
#include "fibers/sync/report/misuse.hpp"

namespace waitpoint {

template <std::ptrdiff_t LeastMax = PTRDIFF_MAX>
class counting_semaphore;

namespace sync {

/// The part that is independent of the greatest count.
class SemaphoreCore {
 public:
  constexpr SemaphoreCore(std::ptrdiff_t initial, std::ptrdiff_t most, const char* label)
      : object_("semaphore", label), initial_(initial), most_(most) {
    WAITPOINT_REQUIRE(initial >= 0 && initial <= most, "a semaphore begins with a count out of its range");
  }

  [[gnu::always_inline]] void release(std::ptrdiff_t units) {
#ifndef WAITPOINT_SEEN_BY_THREAD_SANITIZER
    if (units == 1 && count_ < most_ && kernel::try_fast_waitpoint(kernel::Operation::release, object_)) {
      if (wake_one(object_) == nullptr)
        ++count_;
      else
        kernel::note_transfer();
      return;
    }
#endif
    release_slow(units);
  }
  [[gnu::always_inline]] bool acquire_before(Time deadline) {
    const Outcome outcome = acquire_now(deadline);
    return outcome == Outcome::must_wait ? block(object_, deadline) : outcome == Outcome::acquired;
  }
  bool try_acquire();

 private:
  enum class Outcome { acquired, too_late, must_wait };

  [[gnu::always_inline]] Outcome acquire_now(Time deadline) {
#ifndef WAITPOINT_SEEN_BY_THREAD_SANITIZER
    if (kernel::try_fast_waitpoint(kernel::Operation::acquire, object_)) return take_before(*kernel::running, deadline);
#endif
    return acquire_slow(deadline);
  }
  Outcome take_before(const kernel::Task& task, Time deadline) {
    if (take()) return Outcome::acquired;
    return deadline != Time::max() && deadline <= task.local_time ? Outcome::too_late : Outcome::must_wait;
  }
  bool take() {
    if (count_ == 0) return false;
    --count_;
    kernel::note_transfer();
    return true;
  }
  Outcome acquire_slow(Time deadline);
  void release_slow(std::ptrdiff_t units);
  bool pass(kernel::Operation operation);

  Object object_;
  std::ptrdiff_t initial_;
  std::ptrdiff_t most_;
  std::ptrdiff_t count_ = 0;
};

}  // namespace sync

template <std::ptrdiff_t LeastMax>
class counting_semaphore {
  static_assert(LeastMax >= 0);

 public:
  /// `label` is shown in reports; it must outlive the semaphore.
  constexpr explicit counting_semaphore(std::ptrdiff_t initial, const char* label = "")
      : core_(initial, LeastMax, label) {}
  counting_semaphore(const counting_semaphore&) = delete;
  counting_semaphore& operator=(const counting_semaphore&) = delete;

  static constexpr std::ptrdiff_t max() noexcept { return LeastMax; }

  /// Adds units; a sum above max() is a misuse.
  [[gnu::always_inline]] void release(std::ptrdiff_t units = 1) { core_.release(units); }
  [[gnu::always_inline]] void acquire() { core_.acquire_before(Time::max()); }
  bool try_acquire() { return core_.try_acquire(); }
  template <class Rep, class Ratio>
  [[gnu::always_inline]] bool try_acquire_for(const std::chrono::duration<Rep, Ratio>& span) {
    return core_.acquire_before(sync::after(span));
  }
  template <class Clock, class Span>
  [[gnu::always_inline]] bool try_acquire_until(const std::chrono::time_point<Clock, Span>& deadline) {
    return core_.acquire_before(sync::until(deadline));
  }

 private:
  sync::SemaphoreCore core_;
};

using binary_semaphore = counting_semaphore<1>;

}  // namespace waitpoint
