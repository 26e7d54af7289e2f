// SPDX-License-Identifier: BSD-3-Clause
// The timers of a program: they end with it, and a forked child does not inherit them.
#pragma once

namespace waitpoint::posix {

struct Program;

/// Stops those of setitimer() and alarm().
void forget_interval_timers(Program& program);
/// Deletes those of timer_create().
void forget_created_timers(Program& program);
/// Forgets what is notified by a thread.
void forget_notices(Program& program);

inline void forget_timers_of(Program& program) {
  forget_interval_timers(program);
  forget_created_timers(program);
  forget_notices(program);
}

}  // namespace waitpoint::posix
