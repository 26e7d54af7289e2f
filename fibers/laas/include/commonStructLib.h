/* SPDX-License-Identifier: BSD-3-Clause */
/* Structures shared by the tasks of a program, with a mutex each. */
#ifndef WAITPOINT_LAAS_COMMONSTRUCTLIB_H
#define WAITPOINT_LAAS_COMMONSTRUCTLIB_H

#include "fibers/laas/include/semLib.h"

/* Directions of commonStructCopy(): to the caller's memory, or from it. */
#define TO 0
#define FROM 1

#define M_commonStructLib 506
#define S_commonStructLib_ISNT_COMMON_STRUCT H2_ENCODE_ERR(M_commonStructLib, 0)

#ifdef __cplusplus
extern "C" {
#endif

/* Zeroed memory of `len` bytes. */
STATUS commonStructCreate(int len, void** pStructAdrs);
STATUS commonStructDelete(const void* pCommonStruct);
STATUS commonStructTake(const void* pCommonStruct);
STATUS commonStructGive(const void* pCommonStruct);
/* Copies all of it, under the mutex. */
STATUS commonStructCopy(void* pCommonStruct, int toFromFlag, void* pBuf);

#ifdef __cplusplus
}
#endif

#endif
