// SPDX-License-Identifier: BSD-3-Clause
//
// Calls that move data from or into a pipe without copying it to the program. They wait for both ends.
#include <fcntl.h>
#include <limits.h>
#include <sys/eventfd.h>
#include <sys/sendfile.h>
#include <sys/uio.h>
#include <unistd.h>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/input_output/input_output.hpp"
#include "fibers/posix/links/stream_links.hpp"
#include "fibers/posix/signals/cancellation.hpp"

namespace waitpoint::posix {
namespace {

bool prepare_end(int descriptor, short events, bool may_block) {
  const DescriptorClass of = class_of(descriptor);
  if (of == DescriptorClass::file) return true;
  const auto operation = events == POLLIN ? kernel::Operation::receive : kernel::Operation::send;
  return prepare(descriptor, of, operation, events, may_block);
}

// False if the call fails at once: `pipes` of the two descriptors must be pipes.
bool can_move(int from, int to, int pipes) {
  const ErrorNumberKept kept;
  const bool are_open = WAITPOINT_NEXT(fcntl)(to, F_GETFL) >= 0 && WAITPOINT_NEXT(fcntl)(from, F_GETFL) >= 0;
  const int found = (class_of(from) == DescriptorClass::pipe ? 1 : 0) + (class_of(to) == DescriptorClass::pipe ? 1 : 0);
  return are_open && found >= pipes;
}

/// Makes `call` without waiting once both ends are ready; repeats it if another thread was faster.
template <class Call>
ssize_t move_between(int from, int to, int pipes, unsigned flags, Call call) {
  WAITPOINT_CHECK(pipes == 1 || pipes == 2, "data is moved between none or more than two pipes");
  for (const int end : {from, to}) end_counting(end);
  if (!is_simulated()) return call(flags);
  if (goes_over_link(to)) return fail(EINVAL);
  const bool may_block = (flags & SPLICE_F_NONBLOCK) == 0 && can_move(from >= 0 ? from : to, to, pipes);
  for (;;) {
    if (from >= 0 && !prepare_end(from, POLLIN, may_block)) return -1;
    if (!prepare_end(to, POLLOUT, may_block)) return -1;
    const ssize_t moved = done([&] { return call(flags | SPLICE_F_NONBLOCK); });
    if (moved >= 0 || errno != EAGAIN || !may_block || !blocks(to) || (from >= 0 && !blocks(from))) return moved;
  }
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED ssize_t splice(int from, off64_t* from_at, int to, off64_t* to_at, std::size_t size,
                                    unsigned flags) {
  return move_between(from, to, 1, flags,
                      [&](unsigned how) { return WAITPOINT_NEXT(splice)(from, from_at, to, to_at, size, how); });
}

WAITPOINT_INTERPOSED ssize_t tee(int from, int to, std::size_t size, unsigned flags) {
  return move_between(from, to, 2, flags, [&](unsigned how) { return WAITPOINT_NEXT(tee)(from, to, size, how); });
}

// Into the write end of a pipe, or out of its read end.
WAITPOINT_INTERPOSED ssize_t vmsplice(int pipe, const iovec* pieces, std::size_t count, unsigned flags) {
  const auto call = [&](unsigned how) { return WAITPOINT_NEXT(vmsplice)(pipe, pieces, count, how); };
  end_counting(pipe);
  const int mode = WAITPOINT_NEXT(fcntl)(pipe, F_GETFL);
  if (mode >= 0 && (mode & O_ACCMODE) == O_RDONLY) return receive(pipe, true, [&] { return call(flags); });
  return move_between(-1, pipe, 1, flags, call);
}

// A pipe accepts as much as it has room for; a socket all, in pieces.
WAITPOINT_INTERPOSED ssize_t sendfile64(int to, int from, off64_t* at, std::size_t size) noexcept {
  if (goes_over_link(to)) return fail(EINVAL);
  end_counting(to);
  const DescriptorClass of = class_of(to);
  if (of == DescriptorClass::file || !blocks(to))
    return send_all_at_once(to, false, [&] { return WAITPOINT_NEXT(sendfile64)(to, from, at, size); });
  const CancellationDisabled undisturbed;
  if (of == DescriptorClass::pipe) {
    if (!prepare(to, of, kernel::Operation::send, POLLOUT, true)) return -1;
    return done([&] { return WAITPOINT_NEXT(sendfile64)(to, from, at, size); });
  }
  std::size_t sent = 0;
  while (sent < size) {
    if (!prepare(to, of, kernel::Operation::send, POLLOUT, true)) break;
    const std::size_t piece = size - sent > PIPE_BUF ? PIPE_BUF : size - sent;
    const ssize_t count = done([&] { return WAITPOINT_NEXT(sendfile64)(to, from, at, piece); });
    if (count < 0) break;
    if (count == 0) return static_cast<ssize_t>(sent);
    WAITPOINT_CHECK(static_cast<std::size_t>(count) <= piece, "more was sent than was asked for");
    sent += static_cast<std::size_t>(count);
  }
  return sent > 0 || size == 0 ? static_cast<ssize_t>(sent) : -1;
}
extern "C" [[gnu::visibility("default"), gnu::alias("sendfile64")]] ssize_t waitpoint_sendfile(
    int to, int from, off64_t* at, std::size_t size) noexcept __asm__("sendfile");

WAITPOINT_INTERPOSED int eventfd_read(int descriptor, eventfd_t* value) {
  return read(descriptor, value, sizeof *value) == sizeof *value ? 0 : -1;
}
WAITPOINT_INTERPOSED int eventfd_write(int descriptor, eventfd_t value) {
  return write(descriptor, &value, sizeof value) == sizeof value ? 0 : -1;
}
