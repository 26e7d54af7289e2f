// SPDX-License-Identifier: BSD-3-Clause
// Watchdogs: a routine that is called at a tick, once, unless it is cancelled before.
//
// Routines run between tasks, as in pocolibs' clock interrupt: they may give semaphores, signal events, start and
// cancel watchdogs and timers, and must not wait (a bug). Those due at one tick are called with the latest created
// first.
#pragma once

#include <functional>

#include "fibers/laas/portLib.hpp"

namespace waitpoint::laas {

inline constexpr int S_wdLib_ID_ERROR = H2_ENCODE_ERR(34, 1);
inline constexpr int S_wdLib_NOT_ENOUGH_MEMORY = H2_ENCODE_ERR(34, 2);

/// How many watchdogs a robot may have at a time.
inline constexpr std::size_t watchdogs_max = 65536;

struct wdog;
using WDOG_ID = wdog*;

/// A watchdog that is not started; null if there are too many.
WDOG_ID wdCreate();
STATUS wdDelete(WDOG_ID wdId);
/// Has `pRoutine(parameter)` called at the `delay`th tick from now, at least the first: else EINVAL. A watchdog that
/// was started starts again. Without a clock it is a bug.
STATUS wdStart(WDOG_ID wdId, int delay, std::function<void(long)> pRoutine, long parameter);
STATUS wdCancel(WDOG_ID wdId);

}  // namespace waitpoint::laas
