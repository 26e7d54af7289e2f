/* SPDX-License-Identifier: BSD-3-Clause */
/* Common definitions of pocolibs, with the simulation's libraries behind them: docs/laas-pocolibs.md. */
#ifndef WAITPOINT_LAAS_PORTLIB_H
#define WAITPOINT_LAAS_PORTLIB_H

#include "fibers/laas/include/h2errorLib.h"
#include "fibers/laas/include/logLib.h"
#include "fibers/laas/include/portTypes.h"
#include "fibers/laas/include/sysLib.h"

#ifndef FOREVER
#define FOREVER while (TRUE)
#endif
#ifndef MIN
#define MIN(a, b) ((a) < (b) ? (a) : (b))
#endif
#ifndef MAX
#define MAX(a, b) ((a) > (b) ? (a) : (b))
#endif

/* The clock's ticks per second, and a tick in microseconds. */
#define NTICKS_PER_SEC sysClkRateGet()
#define TICK_US (1000000 / NTICKS_PER_SEC)

#define M_portLib 1
#define S_portLib_NO_MEMORY H2_ENCODE_ERR(M_portLib, 1)
#define S_portLib_NO_SUCH_TASK H2_ENCODE_ERR(M_portLib, 2)
#define S_portLib_NOT_IN_A_TASK H2_ENCODE_ERR(M_portLib, 3)
#define S_portLib_INVALID_TASKID H2_ENCODE_ERR(M_portLib, 4)
#define S_portLib_NOT_IMPLEMENTED H2_ENCODE_ERR(M_portLib, 5)

#ifdef __cplusplus
extern "C" {
#endif

/* Starts the robot's clock; 0: no clock. EINVAL for another rate than the first caller's. */
STATUS osInit(int ticksPerSec);
/* No effect: the clock ends with the run. */
void osExit(void);

#ifdef __cplusplus
}
#endif

#endif
