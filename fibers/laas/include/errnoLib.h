/* SPDX-License-Identifier: BSD-3-Clause */
/* Each task's error code of its last failed call: VxWorks' errno, not the C library's. */
#ifndef WAITPOINT_LAAS_ERRNOLIB_H
#define WAITPOINT_LAAS_ERRNOLIB_H

#include "fibers/laas/include/portTypes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* 0 if no call has failed. */
int errnoGet(void);
STATUS errnoSet(int errorValue);

#ifdef __cplusplus
}
#endif

#endif
