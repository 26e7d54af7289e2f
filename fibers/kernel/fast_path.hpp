// SPDX-License-Identifier: BSD-3-Clause
// The fast path: the running task passes its waitpoints at the present instant without a look at the event list, inline
// in its own frame. Open for one task at a time, in the turn (turn.hpp).
//
// In the first-in-first-out order it does so as long as no event of an earlier phase was put in for this instant; in
// the seeded order while there is no other of this instant; where somebody else decides, never.
#pragma once

#include "fibers/kernel/chooser.hpp"
#include "fibers/kernel/limits.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/turn.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::kernel {

class FastPath {
 public:
  // The short way through a waitpoint is inline, in code that ThreadSanitizer may look at: it would take what tasks
  // write to the scheduler for races.
  void allow(Order order) {
    const bool allowed = enabled_ && !sanitizer::present;
    keeps_turn_ = allowed && order == Order::fifo;
    keeps_turn_alone_ = allowed && order == Order::seeded;
  }
  /// Whether allow() allows any.
  void enable(bool enabled) { enabled_ = enabled; }
  bool is_enabled() const { return enabled_; }
  /// From now on nobody has one.
  void forbid() { keeps_turn_ = keeps_turn_alone_ = false; }

  /// Whether a task goes on although others tie with it.
  bool keeps_turn() const { return keeps_turn_; }
  /// The same where others are of its instant or not, as said.
  bool keeps_turn(bool alone) const { return keeps_turn_ || (keeps_turn_alone_ && alone); }

  bool holds_for(const Task& task) const { return task.local_time == turn.at && task.turns < turns_max; }

  /// To the running task, for the instant `now`; `fast_epoch`: the epoch of the run if nobody watches, else no_epoch.
  void open(const Task& task, Time now, std::uint64_t fast_epoch) {
    if (task.attention != 0) return close();
    turn.at = now;
    turn.fast_epoch = fast_epoch;
  }
  void close() { turn.close(); }

  /// An event of this phase was put in for the present instant.
  void note_present_event(Phase phase) {
    if (running != nullptr && (!keeps_turn_ || phase < running->phase)) close();
  }

 private:
  bool enabled_ = true;
  bool keeps_turn_ = false;
  bool keeps_turn_alone_ = false;
};

/// A waitpoint of the running task where nothing can come between, and nobody watches; else false, with nothing done.
[[gnu::always_inline]] inline bool try_fast_waitpoint(Operation operation, Object& object) {
  if (__builtin_expect(object.epoch != turn.fast_epoch, 0)) return false;
  Task& task = *running;
  if (__builtin_expect(task.turns >= turns_max, 0)) return false;
  ++task.turns;
  task.operation = operation;
  task.at = &object;
  count_event(task, operation, &object, turn.at);
  return true;
}

}  // namespace waitpoint::kernel
