/* SPDX-License-Identifier: BSD-3-Clause */
/* Events: a semaphore per task, which counts signals and the letters that come to the task's mailboxes. */
#ifndef WAITPOINT_LAAS_H2EVNLIB_H
#define WAITPOINT_LAAS_H2EVNLIB_H

#include "fibers/laas/include/portLib.h"

#define M_h2evnLib 507
#define S_h2evnLib_BAD_TASK_ID H2_ENCODE_ERR(M_h2evnLib, 0)

#ifdef __cplusplus
extern "C" {
#endif

/* Discards the caller's events. */
void h2evnClear(void);
/* To a task that has called h2evnSusp() or mboxInit(): else S_h2evnLib_BAD_TASK_ID. */
STATUS h2evnSignal(long taskId);
/* Waits for an event and consumes it: TRUE. FALSE at the n+1st tick; 0 waits for ever. */
BOOL h2evnSusp(int timeout);

#ifdef __cplusplus
}
#endif

#endif
