/* SPDX-License-Identifier: BSD-3-Clause */
/* The robot's shared memory, from which posters are made, too. Blocks are zeroed. */
#ifndef WAITPOINT_LAAS_SMMEMLIB_H
#define WAITPOINT_LAAS_SMMEMLIB_H

#include <stddef.h>

#include "fibers/laas/include/portLib.h"

#define SM_MEM_NAME "smMem"
/* Bytes, without h2devInit(). */
#define SM_MEM_SIZE 0x400000

#ifdef __cplusplus
extern "C" {
#endif

STATUS smMemInit(int smMemSize);
STATUS smMemAttach(void);
STATUS smMemEnd(void);
/* 0: addresses are not relative to a base. */
unsigned long smMemBase(void);
/* Null if there is not enough left. */
void* smMemMalloc(size_t nBytes);
void* smMemCalloc(size_t elemNum, size_t elemSize);
void* smMemRealloc(void* pBlock, size_t newSize);
STATUS smMemFree(void* ptr);
/* Logs the bytes used and free. */
void smMemShow(int option);

#ifdef __cplusplus
}
#endif

#endif
