// SPDX-License-Identifier: BSD-3-Clause
// comLib's semaphores and events.
#include "fibers/laas/h2semLib.hpp"

#include "fibers/laas/h2evnLib.hpp"
#include "fibers/laas/include/h2evnLib.h"
#include "fibers/laas/include/h2semLib.h"

namespace laas = waitpoint::laas;

H2SEM_ID h2semAlloc(int type) { return laas::h2semAlloc(type); }

STATUS h2semDelete(H2SEM_ID sem) { return laas::h2semDelete(sem); }

BOOL h2semTake(H2SEM_ID sem, int timeout) { return laas::h2semTake(sem, timeout); }

STATUS h2semGive(H2SEM_ID sem) { return laas::h2semGive(sem); }

BOOL h2semFlush(H2SEM_ID sem) { return laas::h2semFlush(sem); }

STATUS h2semSet(H2SEM_ID sem, int value) { return laas::h2semSet(sem, value); }

void h2evnClear() { laas::h2evnClear(); }

STATUS h2evnSignal(long taskId) { return laas::h2evnSignal(taskId); }

BOOL h2evnSusp(int timeout) { return laas::h2evnSusp(timeout); }
