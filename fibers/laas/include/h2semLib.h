/* SPDX-License-Identifier: BSD-3-Clause */
/* comLib's semaphores, numbered per robot. A time-out of 0 ticks waits for ever, as WAIT_FOREVER does. */
#ifndef WAITPOINT_LAAS_H2SEMLIB_H
#define WAITPOINT_LAAS_H2SEMLIB_H

#include "fibers/laas/include/semLib.h"

#define H2SEM_SYNC 0 /* starts empty */
#define H2SEM_EXCL 1 /* starts with one unit */

/* Semaphores per device, in pocolibs. */
#define MAX_SEM 20

typedef int H2SEM_ID;

#define M_h2semLib 503
#define S_h2semLib_TOO_MANY_SEM H2_ENCODE_ERR(M_h2semLib, 1)
#define S_h2semLib_ALLOC_ERROR H2_ENCODE_ERR(M_h2semLib, 2)
#define S_h2semLib_NOT_A_SEM H2_ENCODE_ERR(M_h2semLib, 3)
#define S_h2semLib_TIMEOUT H2_ENCODE_ERR(M_h2semLib, 4)
#define S_h2semLib_BAD_SEM_TYPE H2_ENCODE_ERR(M_h2semLib, 5)
#define S_h2semLib_PERMISSION_DENIED H2_ENCODE_ERR(M_h2semLib, 6)
#define S_h2semLib_NOT_IMPLEMENTED H2_ENCODE_ERR(M_h2semLib, 7)

#ifdef __cplusplus
extern "C" {
#endif

H2SEM_ID h2semAlloc(int type);
STATUS h2semDelete(H2SEM_ID sem);
/* TRUE with a unit, FALSE without. */
BOOL h2semTake(H2SEM_ID sem, int timeout);
STATUS h2semGive(H2SEM_ID sem);
/* Discards all units. */
BOOL h2semFlush(H2SEM_ID sem);
STATUS h2semSet(H2SEM_ID sem, int value);

#ifdef __cplusplus
}
#endif

#endif
