/* SPDX-License-Identifier: BSD-3-Clause */
/* Addresses in shared memory: all tasks of a robot have the same. */
#ifndef WAITPOINT_LAAS_SMOBJLIB_H
#define WAITPOINT_LAAS_SMOBJLIB_H

#include "fibers/laas/include/smMemLib.h"

#define M_smObjLib 72
#define S_smObjLib_SHMGET_ERROR H2_ENCODE_ERR(M_smObjLib, 10)
#define S_smObjLib_SHMAT_ERROR H2_ENCODE_ERR(M_smObjLib, 11)

#ifdef __cplusplus
extern "C" {
#endif

void* smObjGlobalToLocal(void* globalAdrs);
void* smObjLocalToGlobal(void* localAdrs);

#ifdef __cplusplus
}
#endif

#endif
