// SPDX-License-Identifier: BSD-3-Clause
// A single-use count-down that wakes all waiters at zero, in the names and semantics of std::latch. The timed waits are
// an extension: the standard has none.
//
// After a run, the latch has its initial count again.
#pragma once

#include <cstddef>

#include "fibers/sync/clock.hpp"
#include "fibers/sync/object.hpp"
#include "fibers/sync/report/misuse.hpp"

namespace waitpoint {

class latch {
 public:
  /// A negative count is a misuse. `label` is shown in reports; it must outlive the latch.
  constexpr explicit latch(std::ptrdiff_t expected, const char* label = "")
      : object_("latch", label), expected_(expected) {
    WAITPOINT_REQUIRE(expected >= 0, "a latch expects a negative count");
  }
  latch(const latch&) = delete;
  latch& operator=(const latch&) = delete;

  static constexpr std::ptrdiff_t max() noexcept { return PTRDIFF_MAX; }

  /// A negative argument, or a count that falls below zero, is a misuse.
  void count_down(std::ptrdiff_t by = 1);
  bool try_wait();
  void wait() { wait_before(Time::max()); }
  void arrive_and_wait(std::ptrdiff_t by = 1) {
    count_down(by);
    wait();
  }

  /// False if the count is not zero in time.
  template <class Rep, class Ratio>
  bool try_wait_for(const std::chrono::duration<Rep, Ratio>& span) {
    return wait_before(sync::after(span));
  }
  template <class Clock, class Span>
  bool try_wait_until(const std::chrono::time_point<Clock, Span>& deadline) {
    return wait_before(sync::until(deadline));
  }

 private:
  void refresh();
  bool wait_before(Time deadline);

  sync::Object object_;
  std::ptrdiff_t expected_;
  std::ptrdiff_t count_ = 0;
};

}  // namespace waitpoint
