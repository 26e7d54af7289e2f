/* SPDX-License-Identifier: BSD-3-Clause */
/* VxWorks' tasks. Priorities go from 0, the highest, to 255; each task has a processor of its own. Ids are small
 * numbers, 0 being the caller.
 *
 * Tasks end with the first task of the run, as a process's threads end with main(). */
#ifndef WAITPOINT_LAAS_TASKLIB_H
#define WAITPOINT_LAAS_TASKLIB_H

#include "fibers/laas/include/semLib.h"

/* Accepted and ignored. */
#define VX_FP_TASK 0x0008

/* A task's control block. */
typedef struct OS_TCB OS_TCB, WIND_TCB;

#ifdef __cplusplus
extern "C" {
#endif

STATUS taskLibInit(void);
/* A task that calls start_routine(arg); its id, or ERROR. Without a name it is called "t" and its number. A stack has
 * at least 64 KiB, for the C library's functions, and at most 256 KiB. */
long taskSpawn2(const char* name, int priority, int options, int stackSize, void* (*start_routine)(void*), void* arg);
/* Ends the calling task: 0 or its id. Deleting another task is S_portLib_NOT_IMPLEMENTED. */
STATUS taskDelete(long tid);
const char* taskName(long tid);
long taskNameToId(const char* name);
long taskIdSelf(void);
OS_TCB* taskTcb(long tid);
/* Gives the calling thread a task's name; its id. */
long taskFromThread(const char* name);
/* The caller only, as in pocolibs: S_portLib_NOT_IMPLEMENTED for another task. */
STATUS taskSuspend(long tid);
STATUS taskResume(long tid);
STATUS taskPrioritySet(long tid, int priority);
STATUS taskPriorityGet(long tid, int* pPriority);
/* S_portLib_NOT_IMPLEMENTED, as in pocolibs. */
STATUS taskLock(void);
STATUS taskUnlock(void);
/* Sleeps for the duration of `ticks`; 0 yields. */
STATUS taskDelay(int ticks);
STATUS taskSetUserData(long tid, unsigned long data);
unsigned long taskGetUserData(long tid);
STATUS taskOptionsGet(long tid, int* pOptions);
/* Replaces the options of `mask`. */
STATUS taskOptionsSet(long tid, int mask, int newOptions);

#ifdef __cplusplus
}
#endif

#endif
