/* SPDX-License-Identifier: BSD-3-Clause */
/* VxWorks' semaphores: binary ones, which count as pocolibs' do, counting ones, and mutexes, first come, first served.
 */
#ifndef WAITPOINT_LAAS_SEMLIB_H
#define WAITPOINT_LAAS_SEMLIB_H

#include "fibers/laas/include/portLib.h"

typedef enum SEM_B_STATE { SEM_EMPTY = 0, SEM_FULL = 1 } SEM_B_STATE;

/* Options; both are accepted and ignored. */
enum { SEM_Q_FIFO, SEM_Q_PRIORITY };

typedef struct SEM_ID_STR* SEM_ID;

#define M_semLib 22
#define S_semLib_TOO_MANY_SEM H2_ENCODE_ERR(M_semLib, 1)
#define S_semLib_ALLOC_ERROR H2_ENCODE_ERR(M_semLib, 2)
#define S_semLib_NOT_A_SEM H2_ENCODE_ERR(M_semLib, 3)
#define S_semLib_TIMEOUT H2_ENCODE_ERR(M_semLib, 4)
#define S_semLib_RESOURCE_BUSY H2_ENCODE_ERR(M_semLib, 5)

#ifdef __cplusplus
extern "C" {
#endif

SEM_ID semBCreate(int options, SEM_B_STATE initialState);
SEM_ID semCCreate(int options, int initialCount);
SEM_ID semMCreate(int options);
STATUS semDelete(SEM_ID semId);
STATUS semGive(SEM_ID semId);
/* WAIT_FOREVER waits without limit, NO_WAIT only tries; n ticks end at the n+1st tick: S_semLib_TIMEOUT. */
STATUS semTake(SEM_ID semId, int timeout);
/* Wakes all waiting tasks, without a unit. */
STATUS semFlush(SEM_ID semId);

#ifdef __cplusplus
}
#endif

#endif
