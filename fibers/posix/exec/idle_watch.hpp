// SPDX-License-Identifier: BSD-3-Clause
// Ends a run that goes on without end while nothing happens in it. For the idle limit of virtual time only timeouts and
// timers expire, and no thread of any process wakes another (but by a lock), writes anything or waits for input from
// outside. Or, for 1 000 s at most, timers expire that wake nobody, and no thread could continue without them. At least
// 1 000 events make such a time, so that a long sleep is none.
//
// Events are observed only where virtual time has gone on for an eighth of the limit since the last known wake-up, up
// to the next one: a program that works is not slowed down.
#pragma once

#include "fibers/kernel/task.hpp"

namespace waitpoint::posix {

/// At the beginning of a run.
void begin_idle_watch(const kernel::Scheduler& scheduler);
/// The latest end of the run's next window.
Time next_idle_check();
/// After a window: true if the run is idle.
bool is_idle(kernel::Scheduler& scheduler);

}  // namespace waitpoint::posix
