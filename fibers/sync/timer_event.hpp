// SPDX-License-Identifier: BSD-3-Clause
// Something that happens at a time by itself: an event of no task, whose function runs between tasks, before those of
// its instant. What timers and watchdogs are made of.
//
// The function acts in the name of its robot's timer task, which is none: it has a robot and a time, no stack of its
// own, and cannot wait; a call that would is a bug. Whatever releases or wakes may be called, and is then no waitpoint.
//
// Timers keep no run alive. While nothing is in the event list but timers, only a timer can wake a task; when they have
// fired `barren_max` times so without waking any, they are let go, and the run is found to be what it is: a deadlock.
// Timers that fire at one instant for ever end the run: it makes no progress.
#pragma once

#include <cstdint>

#include "fibers/sync/blocking.hpp"

namespace waitpoint::sync {

/// How often timers may fire on end while no task is left that could go on without them.
inline constexpr std::uint32_t barren_max = 1'000'000;
/// How often they may fire at one instant: more than there can be timers, so that some start again at once each time.
inline constexpr std::uint32_t firings_max = 2 * kernel::events_max;

class TimerEvent {
 public:
  /// `function(of)` is what happens.
  TimerEvent(void (*function)(void*), void* of) : function_(function), of_(of) {
    event_.self = this;
    event_.fire = &TimerEvent::fire;
  }
  ~TimerEvent() { cancel(); }
  TimerEvent(const TimerEvent&) = delete;
  TimerEvent& operator=(const TimerEvent&) = delete;

  /// Happens once, at `time`, not before the present instant, in the name of the robot of `timer`, which has entered
  /// the run and whose number decides between timers of one instant. What was pending is replaced.
  void schedule(Time time, kernel::Object& timer);
  void cancel();

  bool pending() const { return event_.in_list(); }
  /// When it is due, while it is pending; else when it was last due.
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
