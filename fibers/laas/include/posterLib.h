/* SPDX-License-Identifier: BSD-3-Clause */
/* Posters: named memory that tasks of one program write, and others read, under a mutex each, with the date of the last
 * write. All tasks of a robot are one program: any may write. */
#ifndef WAITPOINT_LAAS_POSTERLIB_H
#define WAITPOINT_LAAS_POSTERLIB_H

#include "fibers/laas/include/h2devLib.h"

typedef enum { POSTER_READ, POSTER_WRITE, POSTER_IOCTL } POSTER_OP;

/* Codes of posterIoctl(), with the type of the result. */
#define FIO_GETDATE 1  /* H2TIME: of the last write */
#define FIO_NMSEC 2    /* unsigned long: milliseconds since */
#define FIO_GETSIZE 3  /* size_t */
#define FIO_FRESH 4    /* int: TRUE once it was written */
#define FIO_GETSTATS 5 /* H2_POSTER_STAT_STR, which is cleared */
#define FIO_RESIZE 6   /* size_t: the new size; then the poster is empty */

#define POSTER_LOCAL_MEM 0
#define POSTER_SM_MEM 1
#define POSTER_VME_A32 2
#define POSTER_VME_A24 3
#define POSTER_REMOTE 4

typedef void* POSTER_ID;

#define M_posterLib 510
#define S_posterLib_POSTER_CLOSED H2_ENCODE_ERR(M_posterLib, 0)
#define S_posterLib_NOT_OWNER H2_ENCODE_ERR(M_posterLib, 1)
#define S_posterLib_EMPTY_POSTER H2_ENCODE_ERR(M_posterLib, 3)
#define S_posterLib_BAD_IOCTL_CODE H2_ENCODE_ERR(M_posterLib, 4)
#define S_posterLib_BAD_OP H2_ENCODE_ERR(M_posterLib, 5)
#define S_posterLib_DUPLICATE_POSTER H2_ENCODE_ERR(M_posterLib, 10)
#define S_posterLib_MALLOC_ERROR H2_ENCODE_ERR(M_posterLib, 12)
#define S_posterLib_BAD_FORMAT H2_ENCODE_ERR(M_posterLib, 17)

#ifdef __cplusplus
extern "C" {
#endif

STATUS posterCreate(const char* name, int size, POSTER_ID* pPosterId);
/* ERROR: memory of a bus is not simulated, as it is not supported on Unix. */
STATUS posterMemCreate(const char* name, int busSpace, void* pPool, int size, POSTER_ID* pPosterId);
/* Later calls with its id are S_posterLib_POSTER_CLOSED. */
STATUS posterDelete(POSTER_ID dev);
STATUS posterFind(const char* name, POSTER_ID* pPosterId);
STATUS posterForget(POSTER_ID posterId);
/* The number of bytes, less at the poster's end; 0 with S_posterLib_BAD_FORMAT behind it. */
int posterWrite(POSTER_ID posterId, int offset, void* buf, int nbytes);
int posterRead(POSTER_ID posterId, int offset, void* buf, int nbytes);
/* Locks the poster, to use its memory; the write's date is that of posterGive(). Reading before the first write is
 * S_posterLib_EMPTY_POSTER. */
STATUS posterTake(POSTER_ID posterId, POSTER_OP op);
STATUS posterGive(POSTER_ID posterId);
void* posterAddr(POSTER_ID posterId);
STATUS posterIoctl(POSTER_ID posterId, int code, void* parg);
STATUS posterEndianness(POSTER_ID posterId, H2_ENDIANNESS* endianness);
STATUS posterSetEndianness(POSTER_ID posterId, H2_ENDIANNESS endianness);
char* posterName(POSTER_ID posterId);
/* Log all posters, or their accesses, which are cleared. */
STATUS posterShow(void);
STATUS posterStats(void);

#ifdef __cplusplus
}
#endif

#endif
