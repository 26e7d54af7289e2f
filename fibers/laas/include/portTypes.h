/* SPDX-License-Identifier: BSD-3-Clause */
/* The types and values that all libraries of pocolibs share; portLib.h includes it. */
#ifndef WAITPOINT_LAAS_PORTTYPES_H
#define WAITPOINT_LAAS_PORTTYPES_H

#ifndef OK
#define OK 0
#endif
#ifndef ERROR
#define ERROR (-1)
#endif
#ifndef FALSE
#define FALSE 0
#endif
#ifndef TRUE
#define TRUE 1
#endif
typedef int STATUS;
typedef int BOOL;

/* Special time-outs, in ticks. comLib treats 0 as for ever, too. */
#ifndef WAIT_FOREVER
#define WAIT_FOREVER (-1)
#endif
#ifndef NO_WAIT
#define NO_WAIT 0
#endif

#endif
