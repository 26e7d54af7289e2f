// SPDX-License-Identifier: BSD-3-Clause
// Expirations of the program's timers, as the idle watch sees them: a thread that a timer wakes was woken by no other
// thread.
#pragma once

#include <cstdint>

namespace waitpoint::posix {

extern bool is_timer_firing;
extern std::uint64_t timers_fired;  ///< number so far

/// Scope of the action of an expired timer.
class TimerFiring {
 public:
  TimerFiring() {
    is_timer_firing = true;
    ++timers_fired;
  }
  ~TimerFiring() { is_timer_firing = false; }
  TimerFiring(const TimerFiring&) = delete;
  TimerFiring& operator=(const TimerFiring&) = delete;
};

}  // namespace waitpoint::posix
