// SPDX-License-Identifier: BSD-3-Clause
// Watchdogs: a routine called once, at a tick, unless it is cancelled before.
//
// Routines run between tasks, as in pocolibs' clock interrupt: they may give semaphores, signal events, start and
// cancel watchdogs and timers, and must not wait (a misuse). Those of one tick are called with the latest created
// first.
#pragma once

#include <functional>

#include "fibers/laas/include/wdLib.h"
#include "fibers/laas/portLib.hpp"

namespace waitpoint::laas {

/// The greatest number of watchdogs per robot at a time.
inline constexpr std::size_t watchdogs_max = 65536;

struct wdog;
using WDOG_ID = wdog*;

/// A new, stopped watchdog; null if there are too many.
WDOG_ID wdCreate();
STATUS wdDelete(WDOG_ID wdId);
/// Schedules `pRoutine(parameter)` at the `delay`th tick from now; a delay below 1 is EINVAL. Restarts a watchdog that
/// is started. Without a clock it is a misuse.
STATUS wdStart(WDOG_ID wdId, int delay, std::function<void(long)> pRoutine, long parameter);
STATUS wdCancel(WDOG_ID wdId);

}  // namespace waitpoint::laas
