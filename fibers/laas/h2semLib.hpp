// SPDX-License-Identifier: BSD-3-Clause
// comLib's semaphores: numbers, from one table per robot. A time-out of 0 ticks waits for ever, as WAIT_FOREVER does.
//
// Failures return FALSE or ERROR, and set the caller's error code.
#pragma once

#include "fibers/laas/include/h2semLib.h"
#include "fibers/laas/portLib.hpp"

namespace waitpoint::laas {

/// The greatest number per robot: pocolibs has at most 120 devices of 20 semaphores, the first of which is its own.
inline constexpr int h2_semaphores_max = 120 * MAX_SEM - 1;

/// The id of a new semaphore, the least free; or ERROR.
H2SEM_ID h2semAlloc(int type);
/// Waiting tasks fail with S_h2semLib_NOT_A_SEM.
STATUS h2semDelete(H2SEM_ID sem);
/// TRUE with a unit; FALSE without. 0 and WAIT_FOREVER wait for ever, n ticks end at the n+1st from now.
BOOL h2semTake(H2SEM_ID sem, int timeout);
STATUS h2semGive(H2SEM_ID sem);
/// Empties it: units not yet taken are discarded.
BOOL h2semFlush(H2SEM_ID sem);
/// Sets the number of units; waiting tasks are served from them. A negative count is EINVAL.
STATUS h2semSet(H2SEM_ID sem, int value);

}  // namespace waitpoint::laas
