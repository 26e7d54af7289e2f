/* SPDX-License-Identifier: BSD-3-Clause */
/* Messages on the standard error, each behind its task's name. */
#ifndef WAITPOINT_LAAS_LOGLIB_H
#define WAITPOINT_LAAS_LOGLIB_H

#include "fibers/laas/include/portTypes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* No effect. */
STATUS logInit(int fd, int maxMsgs);
void logEnd(void);
/* Returns the number of characters. */
#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
int logMsg(const char *fmt, ...);

#ifdef __cplusplus
}
#endif

#endif
