/* SPDX-License-Identifier: BSD-3-Clause */
/* The start of a process's libraries. */
#ifndef WAITPOINT_LAAS_H2INITGLOB_H
#define WAITPOINT_LAAS_H2INITGLOB_H

#include "fibers/laas/include/portLib.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Call this before all other functions: starts the robot's clock, 0 being none. */
STATUS h2initGlob(int ticksPerSec);

#ifdef __cplusplus
}
#endif

#endif
