// SPDX-License-Identifier: BSD-3-Clause
//
// Several messages in one call: one after the other, until one fails.
#include <sys/socket.h>

#include <cerrno>

#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/thread.hpp"
#include "fibers/posix/time/clocks.hpp"

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int sendmmsg(int descriptor, mmsghdr* messages, unsigned count, int flags) {
  if (!is_simulated()) return WAITPOINT_NEXT(sendmmsg)(descriptor, messages, count, flags);
  for (unsigned i = 0; i < count; ++i) {
    if (!can_be_written(&messages[i])) return i > 0 ? static_cast<int>(i) : fail(EFAULT);
    const ssize_t sent = sendmsg(descriptor, &messages[i].msg_hdr, flags);
    if (sent < 0) return i > 0 ? static_cast<int>(i) : -1;
    messages[i].msg_len = static_cast<unsigned>(sent);
  }
  return static_cast<int>(count);
}

// The timeout is checked after each message, as in Linux: the wait for the first may be longer.
WAITPOINT_INTERPOSED int recvmmsg(int descriptor, mmsghdr* messages, unsigned count, int flags, timespec* timeout) {
  if (!is_simulated()) return WAITPOINT_NEXT(recvmmsg)(descriptor, messages, count, flags, timeout);
  if (timeout != nullptr && !can_be_read(timeout)) return fail(EFAULT);
  if (timeout != nullptr && (!is_valid(*timeout) || timeout->tv_sec < 0)) return fail(EINVAL);
  const Time deadline = timeout == nullptr ? Time::max() : later(read_clock(), span(*timeout));
  for (unsigned i = 0; i < count; ++i) {
    if (!can_be_written(&messages[i])) return i > 0 ? static_cast<int>(i) : fail(EFAULT);
    const bool waits = i == 0 || (flags & MSG_WAITFORONE) == 0;
    const ssize_t got =
        recvmsg(descriptor, &messages[i].msg_hdr, (flags & ~MSG_WAITFORONE) | (waits ? 0 : MSG_DONTWAIT));
    if (got < 0) return i > 0 ? static_cast<int>(i) : -1;
    messages[i].msg_len = static_cast<unsigned>(got);
    if (timeout != nullptr && read_clock() >= deadline) return static_cast<int>(i) + 1;
  }
  return static_cast<int>(count);
}
