// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/h2evnLib.hpp"

#include "fibers/laas/tasks.hpp"

namespace waitpoint::laas {

H2SEM_ID h2evnSemaphore() {
  TaskControlBlock& self = Tasks::here().self();
  if (self.events == 0) {
    const H2SEM_ID made = h2semAlloc(H2SEM_SYNC);
    if (made == ERROR) return ERROR;
    self.events = made;
  }
  return self.events;
}

BOOL h2evnSusp(int timeout) {
  const H2SEM_ID events = h2evnSemaphore();
  return events == ERROR ? FALSE : h2semTake(events, timeout);
}

STATUS h2evnSignal(long taskId) {
  const TaskControlBlock* const task = Tasks::here().find(taskId);
  if (task == nullptr || task->events == 0) return fail(S_h2evnLib_BAD_TASK_ID);
  return h2semGive(task->events);
}

void h2evnClear() {
  const TaskControlBlock& self = Tasks::here().self();
  if (self.events != 0) h2semFlush(self.events);
}

}  // namespace waitpoint::laas
