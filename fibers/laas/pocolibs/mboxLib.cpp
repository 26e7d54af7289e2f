// SPDX-License-Identifier: BSD-3-Clause
// Waiting tasks block on the mailbox itself, or, for all mailboxes of a task, on the semaphore of the task's events.
#include <algorithm>
#include <cerrno>
#include <cstring>

#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/laas/h2evnLib.hpp"
#include "fibers/laas/include/h2devLib.h"
#include "fibers/laas/include/mboxLib.h"
#include "fibers/laas/pocolibs/mailboxes.hpp"
#include "fibers/laas/tasks.hpp"
#include "fibers/laas/ticks.hpp"

namespace laas = waitpoint::laas;
using laas::fail;
using laas::Mailbox;
using laas::Mailboxes;
using waitpoint::kernel::Operation;

namespace {

long id_of(long taskId) { return taskId != 0 ? taskId : laas::Tasks::here().self().id; }

// The mailbox, after a waitpoint before `operation`, which does not wait; null, with the error code, if it is closed,
// and at the end of the run: a loop that polls is unwound then.
Mailbox* pass(MBOX_ID id, Operation operation) {
  Mailbox* found = Mailboxes::here().find(id);
  if (found != nullptr) {
    const bool polls = operation == Operation::poll || operation == Operation::receive;
    const bool goes_on = polls ? waitpoint::sync::before_blocking(operation, found->object)
                               : waitpoint::sync::before_releasing(operation, found->object);
    found = goes_on ? Mailboxes::here().find(id) : nullptr;
  }
  if (found == nullptr) fail(S_mboxLib_MBOX_CLOSED);
  return found;
}

// Waits for a message: TRUE, FALSE at the time-out, or ERROR.
BOOL await(MBOX_ID id, int timeout) {
  Mailbox* const mailbox = Mailboxes::here().find(id);
  if (mailbox == nullptr) return fail(S_mboxLib_MBOX_CLOSED);
  if (timeout < WAIT_FOREVER) return fail(EINVAL);
  const std::uint32_t generation = mailbox->generation;
  if (!waitpoint::sync::before_blocking(Operation::receive, mailbox->object)) return ERROR;
  if (generation != mailbox->generation) return fail(S_mboxLib_MBOX_CLOSED);
  const waitpoint::Time deadline = laas::Ticks::here().deadline(timeout == 0 ? WAIT_FOREVER : timeout);
  while (mailbox->messages.empty()) {
    const bool woken = waitpoint::sync::block(mailbox->object, deadline);
    if (generation != mailbox->generation) return fail(S_mboxLib_MBOX_CLOSED);
    if (woken) continue;
    fail(S_h2semLib_TIMEOUT);
    return FALSE;
  }
  return TRUE;
}

// pocolibs discards the events, then looks before each wait.
BOOL await_any(int timeout) {
  const H2SEM_ID events = laas::h2evnSemaphore();
  if (events == ERROR || laas::h2semFlush(events) != TRUE) return ERROR;
  for (;;) {
    for (const int device : Mailboxes::here().of_task(id_of(0))) {
      const Mailbox* const mailbox = pass(device, Operation::poll);
      if (mailbox != nullptr && !mailbox->messages.empty()) return TRUE;
    }
    if (laas::h2semTake(events, timeout) != TRUE) return FALSE;
  }
}

int copy_first(const Mailbox& mailbox, MBOX_ID* pFromId, char* buf, int maxbytes) {
  const Mailbox::Message& first = mailbox.messages.front();
  *pFromId = first.from;
  const int bytes = std::min(static_cast<int>(first.text.size()), std::max(maxbytes, 0));
  std::memcpy(buf, first.text.data(), static_cast<std::size_t>(bytes));
  return bytes;
}

}  // namespace

STATUS mboxInit(const char*) {
  const laas::TaskControlBlock& self = laas::Tasks::here().self();
  auto& tasks = Mailboxes::here().tasks;
  const auto known = tasks.find(self.id);
  if (known != tasks.end() && h2devById(known->second)->type == H2_DEV_TYPE_TASK) return OK;
  if (h2devFind(self.name.c_str(), H2_DEV_TYPE_TASK) != ERROR) return fail(S_mboxLib_NAME_IN_USE);
  laas::errnoSet(0);
  const int device = h2devAlloc(self.name.c_str(), H2_DEV_TYPE_TASK);
  if (device == ERROR || laas::h2evnSemaphore() == ERROR) return ERROR;
  tasks[self.id] = device;
  return OK;
}

STATUS mboxEnd(long taskId) {
  const long task = id_of(taskId);
  auto& tasks = Mailboxes::here().tasks;
  const auto found = tasks.find(task);
  if (found == tasks.end()) return fail(S_mboxLib_NOT_OWNER);
  for (const int device : Mailboxes::here().of_task(task)) mboxDelete(device);
  h2devFree(found->second);
  tasks.erase(task);
  return OK;
}

STATUS mboxCreate(const char* name, int size, MBOX_ID* pMboxId) {
  if (size <= 0) return fail(S_h2rngLib_ILLEGAL_NBYTES);
  const int device = h2devAlloc(name, H2_DEV_TYPE_MBOX);
  if (device == ERROR) return ERROR;
  Mailboxes::here().open(device, name, size, id_of(0));
  *pMboxId = device;
  return OK;
}

STATUS mboxResize(MBOX_ID mboxId, int size) {
  Mailbox* const mailbox = pass(mboxId, Operation::release);
  if (mailbox == nullptr) return ERROR;
  if (Mailbox::ring_bytes(size) < Mailbox::ring_bytes(mailbox->size)) return fail(S_h2rngLib_ILLEGAL_NBYTES);
  mailbox->size = size;
  return OK;
}

STATUS mboxDelete(MBOX_ID mboxId) {
  Mailbox* const mailbox = pass(mboxId, Operation::close);
  if (mailbox == nullptr) return ERROR;
  Mailboxes::here().close(*mailbox);
  return h2devFree(mboxId);
}

STATUS mboxFind(const char* name, MBOX_ID* pMboxId) {
  const int device = h2devFind(name, H2_DEV_TYPE_MBOX);
  if (device == ERROR) return ERROR;
  *pMboxId = device;
  return OK;
}

STATUS mboxIoctl(MBOX_ID mboxId, int codeFunc, void* pArg) {
  Mailbox* const mailbox = pass(mboxId, codeFunc == FIO_FLUSH ? Operation::receive : Operation::poll);
  if (mailbox == nullptr) return ERROR;
  switch (codeFunc) {
    case FIO_NBYTES: *static_cast<int*>(pArg) = mailbox->used; return OK;
    case FIO_NMSGS: *static_cast<int*>(pArg) = static_cast<int>(mailbox->messages.size()); return OK;
    case FIO_SIZE: *static_cast<int*>(pArg) = mailbox->size; return OK;
    case FIO_GETNAME: std::strcpy(static_cast<char*>(pArg), mailbox->name.c_str()); return OK;
    case FIO_FLUSH: mailbox->clear(); return OK;
    default: return fail(S_mboxLib_BAD_IOCTL_CODE);
  }
}

BOOL mboxPause(MBOX_ID mboxId, int timeout) { return mboxId == ALL_MBOX ? await_any(timeout) : await(mboxId, timeout); }

int mboxRcv(MBOX_ID mboxId, MBOX_ID* pFromId, char* buf, int maxbytes, int timeout) {
  const BOOL came = await(mboxId, timeout);
  if (came != TRUE) return came;
  Mailbox& mailbox = *Mailboxes::here().find(mboxId);
  const int bytes = static_cast<int>(mailbox.messages.front().text.size());
  if (bytes > maxbytes) {
    mailbox.clear();
    return fail(S_h2rngLib_SMALL_BUF);
  }
  copy_first(mailbox, pFromId, buf, maxbytes);
  mailbox.pop();
  return bytes;
}

STATUS mboxSend(MBOX_ID toId, MBOX_ID fromId, char* buf, int nbytes) {
  Mailbox* const mailbox = pass(toId, Operation::send);
  if (mailbox == nullptr) return ERROR;
  if (nbytes <= 0) return fail(S_h2rngLib_ILLEGAL_NBYTES);
  if (!mailbox->has_room(nbytes)) return fail(S_mboxLib_MBOX_FULL);
  mailbox->push(fromId, buf, nbytes);
  waitpoint::kernel::wake_all(*waitpoint::sync::running_task().scheduler, mailbox->object);
  const laas::TaskControlBlock* const owner = laas::Tasks::here().find(mailbox->owner);
  return owner == nullptr || owner->events == 0 ? OK : laas::h2semSet(owner->events, 1);
}

STATUS mboxSkip(MBOX_ID mboxId) {
  Mailbox* const mailbox = pass(mboxId, Operation::receive);
  if (mailbox == nullptr) return ERROR;
  if (!mailbox->messages.empty()) mailbox->pop();
  return OK;
}

int mboxSpy(MBOX_ID mboxId, MBOX_ID* pFromId, int* pNbytes, char* buf, int maxbytes) {
  const Mailbox* const mailbox = pass(mboxId, Operation::poll);
  if (mailbox == nullptr) return ERROR;
  if (mailbox->messages.empty()) return 0;
  *pNbytes = static_cast<int>(mailbox->messages.front().text.size());
  return copy_first(*mailbox, pFromId, buf, maxbytes);
}

void mboxShow() {
  logMsg("\n");
  logMsg("Name                              Id     Size NMes    Bytes\n");
  logMsg("-------------------------------- --- -------- ---- --------\n");
  for (int index = 0; index < h2devSize(); ++index) {
    const H2_DEV_STR& device = *h2devByIndex(static_cast<unsigned>(index));
    const Mailbox* const mailbox = Mailboxes::here().find(static_cast<int>(device.devgen));
    if (device.type == H2_DEV_TYPE_MBOX && mailbox != nullptr)
      logMsg("%-32s %3d %8d %4zu %8d\n", device.name, mailbox->device, mailbox->size, mailbox->messages.size(),
             mailbox->used);
  }
}
