// SPDX-License-Identifier: BSD-3-Clause
// A robot's clock: ticks at the multiples of 1/rate from where h2initGlob() started it, and what is to be done at them.
//
// No tick is walked at which nothing is due: the clock's one event stands at the next tick that has something to do,
// and an idle robot has none. What is due at one tick is done in the order in which pocolibs' walk would come to it:
// the watchdogs, the latest created first, then the h2 timers in the order of their table. What is started at tick k
// counts from k, wherever it stands in that walk. All that comes before the tasks of that instant.
#pragma once

#include <cstdint>
#include <optional>
#include <set>

#include "fibers/laas/portLib.hpp"
#include "fibers/sync/robot_state.hpp"
#include "fibers/sync/timer_event.hpp"

namespace waitpoint::laas {

/// Something that is done at a tick.
class TickItem {
 public:
  virtual ~TickItem() = default;

 private:
  friend class Ticks;
  virtual void at_tick() = 0;
  std::int64_t due_ = 0;
  std::uint64_t rank_ = 0;  // among those of one tick
  bool listed_ = false;
};

class Ticks : public sync::RobotState {
 public:
  explicit Ticks(kernel::Robot&) : event_(&Ticks::fire, this) {}
  /// Those of the caller's robot.
  static Ticks& here() { return sync::state_of<Ticks>(*sync::running_task().robot); }

  /// See h2initGlob().
  STATUS start(int ticks_per_second);
  bool running() const { return rate_ > 0; }
  int rate() const { return rate_; }

  /// The last tick that came until the caller's local time; tick 0 is the start. The clock runs.
  std::int64_t now() const;
  Time time_of(std::int64_t tick) const;
  /// How long `ticks` last.
  Duration span(std::int64_t ticks) const;
  /// When a time-out of `ticks` ends. pocolibs asks at each tick whether more than `ticks` have come since the call, so
  /// it is the n+1st. WAIT_FOREVER never ends, NO_WAIT is past. A finite one without a clock is a bug.
  Time deadline(int ticks) const;

  /// Has `item` done at tick `due`, a later one than now; what it was listed for before is forgotten.
  void list(TickItem& item, std::int64_t due, std::uint64_t rank);
  void unlist(TickItem& item);
  static bool listed(const TickItem& item) { return item.listed_; }

  /// What meets at the clock.
  kernel::Object& object() { return object_; }
  /// What tickSet() added to the count.
  std::uint64_t offset = 0;

 private:
  struct Before {
    bool operator()(const TickItem* a, const TickItem* b) const {
      return a->due_ != b->due_ ? a->due_ < b->due_ : a->rank_ < b->rank_;
    }
  };
  static void fire(void* self);
  void schedule();

  kernel::Object object_{"tick"};
  sync::TimerEvent event_;
  std::set<TickItem*, Before> items_;  // no two have both the same tick and the same rank
  std::optional<Period> period_;
  Time start_;
  int rate_ = 0;
  std::int64_t scheduled_ = 0;  // the tick at which the event stands
  bool firing_ = false;
};

}  // namespace waitpoint::laas
