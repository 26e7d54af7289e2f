/* SPDX-License-Identifier: BSD-3-Clause */
/* Periodic timers. One first fires at the next tick whose number modulo 20 is its delay, then every period. */
#ifndef WAITPOINT_LAAS_H2TIMERLIB_H
#define WAITPOINT_LAAS_H2TIMERLIB_H

#include "fibers/laas/include/semLib.h"

#define NMAX_TIMERS 20
#define MAX_DELAY 20

typedef struct H2TIMER H2TIMER, *H2TIMER_ID;

#define M_h2timerLib 504
#define S_h2timerLib_TIMER_NOT_INIT H2_ENCODE_ERR(M_h2timerLib, 0)
#define S_h2timerLib_BAD_DELAY H2_ENCODE_ERR(M_h2timerLib, 1)
#define S_h2timerLib_TOO_MUCH_TIMERS H2_ENCODE_ERR(M_h2timerLib, 2)
#define S_h2timerLib_STOPPED_TIMER H2_ENCODE_ERR(M_h2timerLib, 3)
#define S_h2timerLib_NOT_STOPPED_TIMER H2_ENCODE_ERR(M_h2timerLib, 4)
#define S_h2timerLib_BAD_PERIOD H2_ENCODE_ERR(M_h2timerLib, 5)

#ifdef __cplusplus
extern "C" {
#endif

/* No effect: a robot with a clock has timers. */
STATUS h2timerInit(void);
STATUS h2timerEnd(void);
/* A stopped timer; null without a clock, or if all are in use. */
H2TIMER_ID h2timerAlloc(void);
STATUS h2timerStart(H2TIMER_ID timerId, int periode, int delay);
/* Waits for the timer to fire; missed firings count as one. */
STATUS h2timerPause(H2TIMER_ID timerId);
/* The same, and begins a new period. */
STATUS h2timerPauseReset(H2TIMER_ID timerId);
STATUS h2timerStop(H2TIMER_ID timerId);
STATUS h2timerChangePeriod(H2TIMER_ID timerId, int periode);
STATUS h2timerFree(H2TIMER_ID timerId);

#ifdef __cplusplus
}
#endif

#endif
