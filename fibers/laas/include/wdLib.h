/* SPDX-License-Identifier: BSD-3-Clause */
/* Watchdogs: a routine called once, at a tick, between tasks; it must not wait. */
#ifndef WAITPOINT_LAAS_WDLIB_H
#define WAITPOINT_LAAS_WDLIB_H

#include "fibers/laas/include/portLib.h"

typedef void (*WDROUTINEFUNC)(long);
typedef struct wdog* WDOG_ID;

#define M_wdLib 34
#define S_wdLib_ID_ERROR H2_ENCODE_ERR(M_wdLib, 1)
#define S_wdLib_NOT_ENOUGH_MEMORY H2_ENCODE_ERR(M_wdLib, 2)

#ifdef __cplusplus
extern "C" {
#endif

STATUS wdLibInit(void);
WDOG_ID wdCreate(void);
STATUS wdDelete(WDOG_ID wdId);
/* At the `delay`th tick from now; restarts a started one. */
STATUS wdStart(WDOG_ID wdId, int delay, WDROUTINEFUNC pRoutine, long parameter);
STATUS wdCancel(WDOG_ID wdId);

#ifdef __cplusplus
}
#endif

#endif
