// SPDX-License-Identifier: BSD-3-Clause
// A scheduled function call: an event without a task, whose function runs between tasks, before those of its instant.
// Timers and watchdogs are built on it.
//
// The function runs as its robot's timer task, a pseudo-task with a robot and a time but no stack, so it cannot block;
// a blocking call is a misuse. Releasing and waking calls are allowed, and are not waitpoints then.
//
// Timers do not keep a run alive. While the event list holds only timers, only a timer can wake a task; after
// `idle_firings_max` consecutive firings without a wake-up the timers are dropped, and the run is reported as a
// deadlock. Timers that fire without end at one instant end the run with no progress.
#pragma once

#include <cstdint>

#include "fibers/sync/blocking.hpp"

namespace waitpoint::sync {

/// The greatest number of consecutive firings while no task can continue without them.
inline constexpr std::uint32_t idle_firings_max = 1'000'000;
/// The greatest number of firings at one instant: above the number of possible timers, so some restarted at once.
inline constexpr std::uint32_t firings_max = 2 * kernel::events_max;

class TimerEvent {
 public:
  /// `function(of)` is called at each firing.
  TimerEvent(void (*function)(void*), void* of) : function_(function), of_(of) {
    event_.self = this;
    event_.fire = &TimerEvent::fire;
  }
  ~TimerEvent() { cancel(); }
  TimerEvent(const TimerEvent&) = delete;
  TimerEvent& operator=(const TimerEvent&) = delete;

  /// Fires once, at `time`, not before the present instant, as the timer task of the robot of `timer`; `timer` must
  /// have entered the run, and its number orders the timers of one instant. Replaces a pending firing.
  void schedule(Time time, kernel::Object& timer);
  void cancel();

  bool pending() const { return event_.in_list(); }
  /// The time of its firing while it is pending, else of the last.
  Time due() const { return due_; }

 private:
  struct Event : kernel::EventNode {
    TimerEvent* self = nullptr;
  };
  static void fire(kernel::EventNode& node);

  Event event_;
  void (*function_)(void*);
  void* of_;
  kernel::Object* timer_ = nullptr;
  Time due_;
};

}  // namespace waitpoint::sync
