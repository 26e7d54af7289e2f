/* SPDX-License-Identifier: BSD-3-Clause */
/* What codels of a generated module use, in C or C++: the names and values of GenoM and of pocolibs' csLib and
 * posterLib. The generated MODULEHeader.h includes it. */
#ifndef WAITPOINT_GENOM_CODELS_H
#define WAITPOINT_GENOM_CODELS_H

#ifndef OK
#define OK 0
#endif
#ifndef ERROR
#define ERROR (-1)
#endif
typedef int STATUS;

/* The state that an activity's codel returns. */
typedef enum { ETHER, INIT, START, EXEC, END, FAIL, INTER, ZOMBIE, SLEEP } ACTIVITY_EVENT;

#define MAX_ACTIVITIES 19

/* Handles of posters and of the clients of modules. */
typedef void *POSTER_ID;
#ifndef CS_LIB_H
typedef void *CLIENT_ID;
#endif

/* Results and modes of the client functions. */
#ifndef GCOM_LIB_H
#define WAITING_INTERMED_REPLY 1
#define INTERMED_REPLY_TIMEOUT 2
#define WAITING_FINAL_REPLY 3
#define FINAL_REPLY_TIMEOUT 4
#define FINAL_REPLY_OK 5
#define NO_BLOCK 1
#define BLOCK_ON_INTERMED_REPLY 2
#define BLOCK_ON_FINAL_REPLY 3
#endif

#endif
