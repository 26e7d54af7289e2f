// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/taskLib.hpp"

#include <algorithm>

#include "fibers/laas/include/taskLib.h"
#include "fibers/laas/tasks.hpp"

namespace laas = waitpoint::laas;

namespace {

// For the C library's functions, printf() first of all, of which pocolibs' stacks are large enough, too.
constexpr int stack_size_min = 64 * 1024;

laas::TaskControlBlock* find(long tid) {
  laas::TaskControlBlock* const task = laas::Tasks::here().find(tid);
  if (task == nullptr) laas::fail(S_portLib_INVALID_TASKID);
  return task;
}

}  // namespace

STATUS taskLibInit() { return OK; }

long taskSpawn2(const char* name, int priority, int options, int stackSize, void* (*start_routine)(void*), void* arg) {
  const int size = stackSize < 0 ? stackSize : std::max(stackSize, stack_size_min);
  // Services, so that the run ends with its first task.
  return laas::spawn_task(name, priority, options | laas::TASK_SERVICE, size,
                          [start_routine, arg] { start_routine(arg); });
}

STATUS taskDelete(long tid) { return laas::taskDelete(tid); }

const char* taskName(long tid) { return laas::taskName(tid); }

long taskNameToId(const char* name) { return laas::taskNameToId(name); }

long taskIdSelf() { return laas::taskIdSelf(); }

OS_TCB* taskTcb(long tid) { return reinterpret_cast<OS_TCB*>(find(tid)); }

long taskFromThread(const char* name) {
  laas::TaskControlBlock& self = laas::Tasks::here().self();
  if (name != nullptr) self.name = name;
  return self.id;
}

STATUS taskSuspend(long tid) { return laas::taskSuspend(tid); }

STATUS taskResume(long tid) { return laas::taskResume(tid); }

STATUS taskPrioritySet(long tid, int priority) { return laas::taskPrioritySet(tid, priority); }

STATUS taskPriorityGet(long tid, int* pPriority) { return laas::taskPriorityGet(tid, pPriority); }

STATUS taskLock() { return laas::fail(S_portLib_NOT_IMPLEMENTED); }

STATUS taskUnlock() { return laas::fail(S_portLib_NOT_IMPLEMENTED); }

STATUS taskDelay(int ticks) { return laas::taskDelay(ticks); }

STATUS taskSetUserData(long tid, unsigned long data) { return laas::taskSetUserData(tid, data); }

unsigned long taskGetUserData(long tid) { return laas::taskGetUserData(tid); }

STATUS taskOptionsGet(long tid, int* pOptions) {
  int options = 0;
  if (laas::taskOptionsGet(tid, &options) != OK) return ERROR;
  if (pOptions != nullptr) *pOptions = options & ~laas::TASK_SERVICE;
  return OK;
}

STATUS taskOptionsSet(long tid, int mask, int newOptions) {
  laas::TaskControlBlock* const task = find(tid);
  if (task == nullptr) return ERROR;
  task->options = (task->options & ~mask) | (newOptions & mask);
  return OK;
}
