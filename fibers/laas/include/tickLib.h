/* SPDX-License-Identifier: BSD-3-Clause */
/* The robot's tick counter. */
#ifndef WAITPOINT_LAAS_TICKLIB_H
#define WAITPOINT_LAAS_TICKLIB_H

#include "fibers/laas/include/portLib.h"

#define M_tickLib 60

#ifdef __cplusplus
extern "C" {
#endif

/* Ticks since the clock started, or since tickSet(). */
unsigned long tickGet(void);
/* Time-outs, watchdogs and timers are unaffected. */
void tickSet(unsigned long ticks);

#ifdef __cplusplus
}
#endif

#endif
