// SPDX-License-Identifier: BSD-3-Clause
// A periodic timer: a recurrent event that wakes who waits for it. While nobody does, it stands in no list: a timer
// alone keeps no run alive.
//
// Tick k comes at start + phase + the k-th multiple of the period, rounded once. Ticks that nobody waited for are not
// lost silently and do not pile up: wait() returns how many have come since it last returned. A tick at the instant of
// a deadline comes before it.
#pragma once

#include <cstdint>

#include "fibers/sync/clock.hpp"
#include "fibers/sync/object.hpp"

namespace waitpoint {

class periodic_timer {
 public:
  /// Starts when first waited for: its first tick is the first multiple after that, plus `phase`, counted from the
  /// start of the run, so that timers of equal periods tick together however their tasks came to start.
  explicit periodic_timer(Period period, Duration phase = Duration(), const char* label = "")
      : object_("timer", label), period_(period), phase_(phase) {
    event_.timer = this;
    event_.fire = &periodic_timer::tick;
  }
  ~periodic_timer();
  periodic_timer(const periodic_timer&) = delete;
  periodic_timer& operator=(const periodic_timer&) = delete;

  /// Waits for the next tick, or returns at once if there was one since the last return. The number of ticks since
  /// then: more than one means missed periods.
  std::int64_t wait() { return wait_before(Time::max()); }
  /// As wait(), but for ticks that come until `deadline`, or within `span`; 0 if there was none.
  std::int64_t wait_until(steady_clock::time_point deadline) { return wait_before(to_time(deadline)); }
  template <class Rep, class Ratio>
  std::int64_t wait_for(const std::chrono::duration<Rep, Ratio>& span) {
    return wait_before(sync::after(span));
  }
  /// How many ticks have come since wait() last returned, without waiting.
  std::int64_t try_wait() { return wait_before(Time()); }

  /// From now on it ticks at the multiples of `period`, plus `phase`, that come after now. Ticks that have come are
  /// kept, and who waits goes on waiting; a stopped timer starts again.
  void set_period(Period period, Duration phase = Duration());
  /// It ticks no more: wait() returns 0 at once, and so do those that wait.
  void stop();

  /// When the last tick that wait() returned was due.
  Time due() const { return due_; }
  /// Ticks that nobody waited for in time, in this run: all but the last of what each wait() returned.
  std::int64_t missed() const { return missed_; }

 private:
  struct Event : kernel::EventNode {
    periodic_timer* timer = nullptr;
  };
  static void tick(kernel::EventNode& node);
  Time time_of(std::int64_t k) const { return Time() + phase_ + period_.tick(k); }
  std::int64_t wait_before(Time deadline);
  void enter();
  void start();
  void catch_up();

  sync::Object object_;
  Event event_;
  kernel::Scheduler* scheduler_ = nullptr;
  Period period_;
  Duration phase_;
  std::int64_t next_ = 0;     // the first tick that has not come yet, or was not yet seen to
  std::int64_t pending_ = 0;  // ticks not yet waited for
  std::int64_t missed_ = 0;
  bool running_ = false;  // started, and not stopped
  Time last_;             // when the last tick that came was due
  Time due_;
};

}  // namespace waitpoint
