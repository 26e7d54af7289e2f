// SPDX-License-Identifier: BSD-3-Clause
// A timer that calls a function, once or periodically. (To wake a task: periodic_timer.)
//
// The callback runs between tasks, before those of its instant; it may notify, release, send signals, start and stop
// timers, and must not block. Timers due at one instant fire in the order of their numbers, which are assigned at the
// first start. A timer does not keep a run alive: see timer_event.hpp.
//
//   waitpoint::timer beat([&] { ready.release(); });
//   beat.start_every(Period::hertz(50));
#pragma once

#include <functional>
#include <optional>

#include "fibers/sync/clock.hpp"
#include "fibers/sync/timer_event.hpp"

namespace waitpoint {

class timer {
 public:
  explicit timer(std::function<void()> callback, const char* label = "")
      : object_("timer", label), callback_(std::move(callback)), event_(&timer::fire, this) {
    WAITPOINT_REQUIRE(callback_ != nullptr, "a timer without a callback");
  }
  /// Stops it. Destruction by its own callback is a misuse.
  ~timer();
  timer(const timer&) = delete;
  timer& operator=(const timer&) = delete;

  /// Fires once, at `time`, or now if that is past. Starting it again replaces the pending start.
  void start_at(Time time);
  void start_at(steady_clock::time_point time) { start_at(to_time(time)); }
  template <class Rep, class Ratio>
  void start_after(const std::chrono::duration<Rep, Ratio>& span) {
    start_at(sync::after(span));
  }
  void start_after(Duration span) { start_after(std::chrono::nanoseconds(span.ns())); }
  /// Fires at every multiple of the period plus `phase`, counted from the start of the run, after the present. On a
  /// running timer, changes the period.
  void start_every(Period period, Duration phase = Duration());
  /// Cancels the timer; true if it was pending.
  bool stop();

  bool pending() const { return event_.pending(); }
  /// The time of its next firing if it is pending, else of the last.
  Time due() const { return event_.due(); }

 private:
  struct Recurrence {
    Period period;
    Duration phase;
    std::int64_t next;  // index of the pending tick
  };
  static void fire(void* self);
  void schedule_next();

  kernel::Object object_;
  std::function<void()> callback_;
  std::optional<Recurrence> recurrence_;
  sync::TimerEvent event_;
  bool firing_ = false;
};

}  // namespace waitpoint
