// SPDX-License-Identifier: BSD-3-Clause
// The fast path: the running task passes its waitpoints at the present instant inline in its own frame, without a
// search of the event list. It is open for one task at a time; its state is in the turn (turn.hpp).
//
// In the first-in-first-out order it is open until an event of an earlier phase is inserted at this instant; in the
// seeded order while the task is alone at this instant; in the explored order never.
#pragma once

#include "fibers/kernel/chooser.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/turn.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::kernel {

class FastPath {
 public:
  /// Allows the fast path as far as `order` does. Never with a sanitizer: the fast path is inlined into code that
  /// ThreadSanitizer may instrument, and the tasks' writes to the scheduler would be reported as races.
  void allow(Order order) {
    const bool allowed = enabled_ && !sanitizer::present;
    passes_ties_ = allowed && order == Order::fifo;
    passes_alone_ = allowed && order == Order::seeded;
  }
  /// Makes later calls of allow() effective, or not.
  void enable(bool enabled) { enabled_ = enabled; }
  bool is_enabled() const { return enabled_; }
  /// Forbids the fast path and the short cuts until the next allow().
  void forbid() { passes_ties_ = passes_alone_ = takes_short_cuts_ = false; }

  /// The calls of fast_calls.cpp, which need the first-in-first-out order, are allowed, or not.
  void allow_short_cuts(bool allowed) { takes_short_cuts_ = allowed && passes_ties_; }
  bool takes_short_cuts() const { return takes_short_cuts_; }

  /// True if a task at a waitpoint continues although others tie with it.
  bool passes_ties() const { return passes_ties_; }
  /// True if it continues; `alone`: no other event is due at its instant.
  bool passes_ties(bool alone) const { return passes_ties_ || (passes_alone_ && alone); }

  /// Opens the path to the running task for the instant `now`. `fast_epoch`: the epoch of the run, or no_epoch if
  /// events are watched.
  void open(const Task& task, Time now, std::uint64_t fast_epoch) {
    if (task.attention != 0) return turn.close();
    turn.at = now;
    turn.fast_epoch = fast_epoch;
  }
  /// An event of this phase was inserted at the present instant.
  void note_present_event(Phase phase) {
    if (running != nullptr && (!passes_ties_ || phase < running->phase)) turn.close();
  }

 private:
  bool enabled_ = true;
  bool passes_ties_ = false;
  bool passes_alone_ = false;
  bool takes_short_cuts_ = false;
};

}  // namespace waitpoint::kernel
