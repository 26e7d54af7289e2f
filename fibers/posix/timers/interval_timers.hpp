// SPDX-License-Identifier: BSD-3-Clause
// Timers that a forked child does not inherit.
#pragma once

namespace waitpoint::posix {

/// Stops those of setitimer() and alarm().
void forget_interval_timers();
/// Deletes those of timer_create().
void forget_timers();

}  // namespace waitpoint::posix
