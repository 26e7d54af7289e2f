// SPDX-License-Identifier: BSD-3-Clause
//
// The calls for System V message queues.
#include <sys/msg.h>
#include <unistd.h>

#include <climits>
#include <cstring>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/ipc/system_v_queue.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"

namespace waitpoint::posix::system_v {
namespace {

int tell_status(const Queue& queue, msqid_ds* to) {
  *to = {};
  to->msg_perm = queue.permissions;
  to->msg_stime = queue.sent;
  to->msg_rtime = queue.received;
  to->msg_ctime = queue.changed;
  to->__msg_cbytes = queue.bytes;
  to->msg_qnum = queue.count;
  to->msg_qbytes = queue.bytes_max;
  to->msg_lspid = queue.last_sender;
  to->msg_lrpid = queue.last_receiver;
  return 0;
}

int tell_limits(void* to, bool used) {
  static_assert(queues_max <= INT_MAX / static_cast<int>(bytes_a_queue_max), "msgpool is an int");
  msginfo limits{};
  limits.msgmni = queues_max;
  limits.msgmax = static_cast<int>(bytes_a_message_max);
  limits.msgmnb = static_cast<int>(bytes_a_queue_max);
  limits.msgssz = 16;
  limits.msgseg = 0xFFFF;
  limits.msgmap = limits.msgmnb;
  limits.msgpool = queues_max * limits.msgmnb / 1024;
  limits.msgtql = limits.msgmnb;
  if (used) limits.msgpool = limits.msgmap = limits.msgtql = 0;
  for (int slot = 0; used && slot < queues().end(); ++slot)
    if (const Queue* queue = queues().in_slot(slot); queue != nullptr) {
      ++limits.msgpool;
      limits.msgmap += static_cast<int>(queue->count);
      limits.msgtql += static_cast<int>(queue->bytes);
    }
  std::memcpy(to, &limits, sizeof limits);
  return queues().greatest_slot();
}

int control(Queue& queue, int command, msqid_ds* status) {
  switch (command) {
    case IPC_STAT: return is_allowed(queue, 4) ? tell_status(queue, status) : fail(EACCES);
    case IPC_SET:
      if (!is_owner(queue)) return fail(EPERM);
      if (status->msg_qbytes > bytes_a_queue_max && geteuid() != 0) return fail(EPERM);
      set_owner(queue, status->msg_perm);
      queue.bytes_max = status->msg_qbytes;
      queue.changed = date();
      wake_senders(queue);
      return 0;
    case IPC_RMID:
      if (!is_owner(queue)) return fail(EPERM);
      queues().remove(queue);
      end_all(queue, EIDRM);
      return 0;
    default: return fail(EINVAL);
  }
}

}  // namespace

}  // namespace waitpoint::posix::system_v

using namespace waitpoint;
using namespace waitpoint::posix;
using namespace waitpoint::posix::system_v;

WAITPOINT_INTERPOSED int msgget(key_t key, int flags) noexcept {
  pass_if_simulated(kernel::Operation::open, nullptr);
  return queues().get(
      key, flags, [](const Queue&) { return 0; },
      [](Queue*& made) {
        made = make_object<Queue>();
        if (made == nullptr) return ENOMEM;
        made->changed = date();
        return 0;
      });
}

WAITPOINT_INTERPOSED int msgsnd(int id, const void* message, std::size_t size, int flags) {
  long type = 0;
  if (!can_be_read(message)) return fail(EFAULT);
  std::memcpy(&type, message, sizeof type);
  if (size > bytes_a_message_max || type < 1) return fail(EINVAL);
  int result = 0;
  {
    const Use<Queue> queue([&] { return queues().find(id); });
    if (!queue) return fail(EINVAL);
    if (!is_allowed(*queue, 2)) return fail(EACCES);
    result = send_message(*queue, type, static_cast<const char*>(message) + sizeof type, size, flags);
  }
  if (is_simulated()) leave_if_cancelled();
  return result;
}

WAITPOINT_INTERPOSED ssize_t msgrcv(int id, void* to, std::size_t size, long type, int flags) {
  if (size > SSIZE_MAX) return fail(EINVAL);
  const bool is_copy = (flags & MSG_COPY) != 0;
  if (is_copy && ((flags & MSG_EXCEPT) != 0 || (flags & IPC_NOWAIT) == 0)) return fail(EINVAL);
  ssize_t result = -1;
  {
    const Use<Queue> queue([&] { return queues().find(id); });
    if (!queue) return fail(EINVAL);
    if (!is_allowed(*queue, 4)) return fail(EACCES);
    if (!can_be_written(to)) return fail(EFAULT);
    result = take_message(*queue, {type, size, flags}, to);
  }
  if (result < 0 && is_simulated()) leave_if_cancelled();
  return result;
}

WAITPOINT_INTERPOSED int msgctl(int id, int command, msqid_ds* status) noexcept {
  if (id < 0 || command < 0) return fail(EINVAL);
  if (command == IPC_INFO || command == MSG_INFO) {
    if (!has_memory(command, true, status)) return fail(EFAULT);
    return tell_limits(status, command == MSG_INFO);
  }
  const bool by_slot = command == MSG_STAT || command == MSG_STAT_ANY;
  const Use<Queue> queue([&] { return by_slot ? queues().in_slot(id) : queues().find(id); });
  if (!queue) return fail(EINVAL);
  if (!has_memory(command, by_slot || command == IPC_STAT, status)) return fail(EFAULT);
  if (by_slot) {
    if (command == MSG_STAT && !is_allowed(*queue, 4)) return fail(EACCES);
    tell_status(*queue, status);
    return queue->id;
  }
  pass_if_simulated(kernel::Operation::modify, &object_of(*queue));
  return queue->removed ? fail(EIDRM) : control(*queue, command, status);
}
