// SPDX-License-Identifier: BSD-3-Clause
// Whether the running task passes its waitpoints at the present instant without a look at the event list: see turn.hpp.
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

class FreePass {
 public:
  // The short way through a waitpoint is inline, in code that ThreadSanitizer may look at: it would take what tasks
  // write to the scheduler for races.
  void allow(Order order) {
    may_stay_ = order == Order::fifo && !sanitizer::present;
    may_stay_alone_ = order == Order::seeded && !sanitizer::present;
  }
  /// From now on nobody has one.
  void forbid() { may_stay_ = may_stay_alone_ = false; }

  /// Whether a task goes on although others tie with it.
  bool may_stay() const { return may_stay_; }
  /// The same where others are of its instant or not, as said.
  bool may_stay(bool alone) const { return may_stay_ || (may_stay_alone_ && alone); }

  bool holds_for(const Task& task) const { return task.local_time == turn.at && task.turns < turns_max; }

  /// To the running task, for the instant `now`; `unseen_in`: the epoch of the run if nobody watches, else no_epoch.
  void give(const Task& task, Time now, std::uint64_t unseen_in) {
    if (task.attention != 0) return end();
    turn.at = now;
    turn.unseen_in = unseen_in;
  }
  void end() { turn.end_pass(); }

  /// An event of this phase was put in for the present instant.
  void note_present_event(Phase phase) {
    if (running != nullptr && (!may_stay_ || phase < running->phase)) end();
  }

 private:
  bool may_stay_ = false;
  bool may_stay_alone_ = false;
};

}  // namespace waitpoint::kernel
