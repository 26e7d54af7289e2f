// SPDX-License-Identifier: BSD-3-Clause
// The present instant, if the running task passes its waitpoints there without a look at the event list.
//
// In the first-in-first-out order it does so as long as no event of an earlier phase was put in for this instant; in
// the seeded order while there is no other of this instant; where somebody else decides, never.
#pragma once

#include "fibers/kernel/chooser.hpp"
#include "fibers/kernel/limits.hpp"
#include "fibers/kernel/sanitizer.hpp"
#include "fibers/kernel/task.hpp"

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

  bool holds_for(const Task& task) const { return task.local_time == at_ && task.turns < turns_max; }
  /// Whether it does for the running task, which nobody watches, at an object of this epoch.
  [[gnu::always_inline]] bool holds_unseen(const Task& task, std::uint64_t epoch) const {
    return __builtin_expect(epoch == unseen_in_, 1) && __builtin_expect(task.turns < turns_max, 1);
  }
  /// Whether the running task passes unseen at the objects of its run.
  [[gnu::always_inline]] bool is_unseen() const { return __builtin_expect(unseen_in_ != no_epoch, 1); }

  /// To the running task, for the instant `now`; `unseen_in`: the epoch of the run if nobody watches, else no_epoch.
  void give(const Task& task, Time now, std::uint64_t unseen_in) {
    if (task.attention != 0) return end();
    at_ = now;
    unseen_in_ = unseen_in;
  }
  void end() {
    at_ = never;
    unseen_in_ = no_epoch;
  }
  static constexpr std::uint64_t no_epoch = ~std::uint64_t{0};

  /// An event of this phase was put in for the present instant.
  void note_present_event(Phase phase) {
    if (running != nullptr && (!may_stay_ || phase < running->phase)) end();
  }

 private:
  static constexpr Time never = Time::from_ns(-1);

  Time at_ = never;
  std::uint64_t unseen_in_ = no_epoch;
  bool may_stay_ = false;
  bool may_stay_alone_ = false;
};

}  // namespace waitpoint::kernel
