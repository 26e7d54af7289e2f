// SPDX-License-Identifier: BSD-3-Clause
// The progress of a run whose virtual time stands still: tasks that only yield to each other make none, nor do tasks
// that exchange something without end.
#pragma once

#include <cstdint>

#include "core/time.hpp"
#include "fibers/kernel/limits.hpp"

namespace waitpoint::kernel {

class RunProgress {
 public:
  /// A task that has passed so many waitpoints since its last yield yields at `now`. `transferred`: a task took what
  /// another one gave since the last call (turn.hpp, note_transfer()).
  void count_yield(Time now, std::uint32_t waitpoints, bool transferred) {
    if (yields_at_ != now) {
      yields_at_ = now;
      idle_yields_ = waitpoints_at_instant_ = 0;
    }
    if (transferred) idle_yields_ = 0;
    waitpoints_at_instant_ += waitpoints;
    ++idle_yields_;
  }
  /// True if the robot of the yielding task goes behind the others, for which it may wait.
  bool ends_turn_of_robot() const { return idle_yields_ % idle_yields_of_robot == 0; }
  /// True if a run of so many tasks makes none.
  bool stands_still(std::uint32_t tasks) const {
    return idle_yields_ > idle_yields_max + std::uint64_t{waitpoints_max} * tasks || is_beyond_limit();
  }

  /// The number of waitpoints at one instant after which a run stands still although its tasks exchange something.
  void set_limit(std::uint64_t waitpoints) { limit_ = waitpoints; }
  bool is_beyond_limit() const { return waitpoints_at_instant_ > limit_; }

  /// Of a new run; the limit is kept.
  void restart() { idle_yields_ = waitpoints_at_instant_ = 0; }

 private:
  std::uint64_t idle_yields_ = 0;            // since virtual time last moved, or a task took what another one gave
  std::uint64_t waitpoints_at_instant_ = 0;  // since virtual time last moved; counted at yields
  std::uint64_t limit_ = instant_limit;
  Time yields_at_;
};

}  // namespace waitpoint::kernel
