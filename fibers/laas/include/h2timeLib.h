/* SPDX-License-Identifier: BSD-3-Clause */
/* Dates, in virtual time: the run's declared start date, and the caller's local time since. */
#ifndef WAITPOINT_LAAS_H2TIMELIB_H
#define WAITPOINT_LAAS_H2TIMELIB_H

#include "fibers/laas/include/portLib.h"

typedef struct H2TIME_STR {
  unsigned long ntick; /* ticks since the start date's midnight */
  unsigned short msec; /* of the second */
  unsigned short sec;
  unsigned short minute;
  unsigned short hour;
  unsigned short day;   /* of the week, Monday being 1, Sunday 7 */
  unsigned short date;  /* of the month, from 1 */
  unsigned short month; /* from 1 */
  unsigned short year;  /* since 1900 */
} H2TIME;

typedef struct H2TIMESPEC_STR {
  long tv_sec;
  long tv_nsec;
} H2TIMESPEC;

#ifdef __cplusplus
extern "C" {
#endif

/* No effect. */
void h2timeInit(void);
STATUS h2timeGet(H2TIME* pTimeStr);
/* Since 1970, in UTC. */
STATUS h2GetTimeSpec(H2TIMESPEC* pTs);
void h2timeFromTimespec(H2TIME* pTimeStr, const H2TIMESPEC* ts);
void timespecFromH2time(H2TIMESPEC* ts, const H2TIME* pTimeStr);
/* Milliseconds from then until now, by the tick counters or the dates. */
STATUS h2timeInterval(H2TIME* pOldTime, unsigned long* pNmsec);
STATUS h2timespecInterval(const H2TIMESPEC* pOldTime, unsigned long* pNmsec);
/* ERROR, as in pocolibs: the date cannot be set. */
STATUS h2timeSet(H2TIME* pTimeStr);
STATUS h2timeAdj(H2TIME* pTimeStr);
/* Logs the date. */
void h2timeShow(void);

#ifdef __cplusplus
}
#endif

#endif
