// SPDX-License-Identifier: BSD-3-Clause
// A robot's clock: ticks at the multiples of 1/rate since its start by h2initGlob(), and the actions scheduled at them.
//
// Ticks without an action cost nothing: the clock has one event, at the next tick with an action, and an idle robot has
// none. The actions of one tick run in the order of pocolibs' walk: the watchdogs, the latest created first, then the
// h2 timers in the order of their table. An action started at tick k counts from k, whatever its place in that walk.
// All actions precede the tasks of that instant.
#pragma once

#include <cstdint>
#include <optional>
#include <set>

#include "fibers/laas/portLib.hpp"
#include "fibers/sync/robot_state.hpp"
#include "fibers/sync/timer_event.hpp"

namespace waitpoint::laas {

/// An action at a tick.
class TickAction {
 public:
  virtual ~TickAction() = default;

 private:
  friend class Ticks;
  virtual void at_tick() = 0;
  std::int64_t due_ = 0;
  std::uint64_t rank_ = 0;  // orders the actions of one tick
  bool listed_ = false;
};

class Ticks : public sync::RobotState {
 public:
  explicit Ticks(kernel::Robot&) : event_(&Ticks::fire, this) {}
  /// The clock of the caller's robot.
  static Ticks& here() { return sync::state_of<Ticks>(*sync::running_task().robot); }

  /// See h2initGlob().
  STATUS start(int ticks_per_second);
  bool running() const { return rate_ > 0; }
  int rate() const { return rate_; }

  /// The last tick not after the caller's local time; tick 0 is the start. The clock must run.
  std::int64_t now() const;
  Time time_of(std::int64_t tick) const;
  /// The duration of `ticks`.
  Duration span(std::int64_t ticks) const;
  /// The end of a time-out of `ticks`: the n+1st tick, since pocolibs checks at each tick for more than `ticks` since
  /// the call. WAIT_FOREVER never ends, NO_WAIT is past. A finite one without a clock is a misuse.
  Time deadline(int ticks) const;

  /// Schedules `item` at tick `due`, which must be in the future; replaces its earlier schedule.
  void list(TickAction& item, std::int64_t due, std::uint64_t rank);
  void unlist(TickAction& item);
  static bool listed(const TickAction& item) { return item.listed_; }

  /// The object of operations on the clock, which conflict.
  kernel::Object& object() { return object_; }
  /// The offset that tickSet() added to the count.
  std::uint64_t offset = 0;

 private:
  struct Before {
    bool operator()(const TickAction* a, const TickAction* b) const {
      return a->due_ != b->due_ ? a->due_ < b->due_ : a->rank_ < b->rank_;
    }
  };
  static void fire(void* self);
  void schedule();

  kernel::Object object_{"tick"};
  sync::TimerEvent event_;
  std::set<TickAction*, Before> items_;  // no two have the same tick and the same rank
  std::optional<Period> period_;
  Time start_;
  int rate_ = 0;
  std::int64_t scheduled_ = 0;  // the tick of the scheduled event
  bool firing_ = false;
};

}  // namespace waitpoint::laas
