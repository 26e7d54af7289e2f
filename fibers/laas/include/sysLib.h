/* SPDX-License-Identifier: BSD-3-Clause */
/* The rate of the robot's clock. */
#ifndef WAITPOINT_LAAS_SYSLIB_H
#define WAITPOINT_LAAS_SYSLIB_H

#include "fibers/laas/include/portTypes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* As osInit(): the clock's rate does not change once it runs. */
STATUS sysClkRateSet(int ticksPerSecond);
/* Ticks per second; 0 without a clock. */
int sysClkRateGet(void);

#ifdef __cplusplus
}
#endif

#endif
