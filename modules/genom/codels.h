/* SPDX-License-Identifier: BSD-3-Clause */
/* What codels of a generated module use, in C or C++: the names and values of GenoM and of pocolibs' csLib and
 * posterLib. The generated MODULEHeader.h includes it. */
#ifndef WAITPOINT_GENOM_CODELS_H
#define WAITPOINT_GENOM_CODELS_H

/* STATUS, CLIENT_ID with the results and modes of client functions, POSTER_ID. */
#include "fibers/laas/include/csLib.h"
#include "fibers/laas/include/posterLib.h"

/* The state that an activity's codel returns. */
typedef enum { ETHER, INIT, START, EXEC, END, FAIL, INTER, ZOMBIE, SLEEP } ACTIVITY_EVENT;

#define MAX_ACTIVITIES 19

#endif
