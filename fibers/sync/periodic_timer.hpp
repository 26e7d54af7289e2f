// SPDX-License-Identifier: BSD-3-Clause
// A periodic timer: a recurrent event that wakes its waiters. Without waiters its event is not scheduled: a timer alone
// does not keep a run alive.
//
// Tick k comes at start + phase + the k-th multiple of the period, rounded once. Ticks without a waiter are neither
// lost nor queued: wait() returns the number of ticks since it last returned. A tick at the instant of a deadline
// precedes it.
#pragma once

#include <cstdint>

#include "fibers/sync/clock.hpp"
#include "fibers/sync/object.hpp"

namespace waitpoint {

class periodic_timer {
 public:
  /// Starts at the first wait: the first tick is the first multiple after that, plus `phase`, counted from the start of
  /// the run, so that timers of equal periods tick together independent of their tasks' start times.
  explicit periodic_timer(Period period, Duration phase = Duration(), const char* label = "")
      : object_("timer", label), period_(period), phase_(phase) {
    event_.timer = this;
    event_.fire = &periodic_timer::tick;
  }
  ~periodic_timer();
  periodic_timer(const periodic_timer&) = delete;
  periodic_timer& operator=(const periodic_timer&) = delete;

  /// Waits for the next tick; returns at once if there was one since the last return. Returns the number of ticks since
  /// then: more than one means missed periods.
  std::int64_t wait() { return wait_before(Time::max()); }
  /// As wait(), but for ticks until `deadline`, or within `span`; 0 if there was none.
  std::int64_t wait_until(steady_clock::time_point deadline) { return wait_before(to_time(deadline)); }
  template <class Rep, class Ratio>
  std::int64_t wait_for(const std::chrono::duration<Rep, Ratio>& span) {
    return wait_before(sync::after(span));
  }
  /// The number of ticks since wait() last returned, without waiting.
  std::int64_t try_wait() { return wait_before(Time()); }

  /// From now on it ticks at the multiples of `period`, plus `phase`, after the present. Earlier ticks are kept,
  /// waiters keep waiting; a stopped timer starts again.
  void set_period(Period period, Duration phase = Duration());
  /// Stops the ticks: present and later calls of wait() return 0 at once.
  void stop();

  /// The time of the last tick that wait() returned.
  Time due() const { return due_; }
  /// Missed ticks in this run: all but the last of each wait()'s result.
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
  std::int64_t next_ = 0;     // the first tick that is in the future, or not yet processed
  std::int64_t pending_ = 0;  // ticks not yet waited for
  std::int64_t missed_ = 0;
  bool running_ = false;  // started, and not stopped
  Time last_;             // the time of the last past tick
  Time due_;
};

}  // namespace waitpoint
