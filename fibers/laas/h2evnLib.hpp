// SPDX-License-Identifier: BSD-3-Clause
// comLib's events: each task has an h2 semaphore that counts its signals, from its first h2evnSusp() on.
#pragma once

#include "fibers/laas/h2semLib.hpp"
#include "fibers/laas/include/h2evnLib.h"

namespace waitpoint::laas {

/// The semaphore of the caller's events, made at the first use; or ERROR.
H2SEM_ID h2evnSemaphore();
/// Waits for an event and consumes it: TRUE. A time-out of 0 waits for ever; n ticks end at the n+1st: FALSE, with
/// S_h2semLib_TIMEOUT.
BOOL h2evnSusp(int timeout);
/// Signals an event to a task of the caller's robot, which must have called h2evnSusp() before: else
/// S_h2evnLib_BAD_TASK_ID.
STATUS h2evnSignal(long taskId);
/// Discards the caller's events.
void h2evnClear();

}  // namespace waitpoint::laas
