// SPDX-License-Identifier: BSD-3-Clause
// What a child that is forked does not have of the timers of the program it was made by.
#pragma once

namespace waitpoint::posix {

/// Those of setitimer() and alarm() are not set any more.
void forget_interval_timers();
/// Those of timer_create() are not there any more.
void forget_timers();

}  // namespace waitpoint::posix
