// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/input_output/input_output.hpp"

#include <fcntl.h>
#include <limits.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "core/error.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

// An outside reader mostly needs only real time. But it may wait for another thread of this program.
constexpr int patience_with_readers_ms = 1000;

// The deadline of a wait for a socket, from SO_RCVTIMEO or SO_SNDTIMEO. With a timeout, SA_RESTART has no effect.
struct Patience {
  Time deadline = Time::max();
  Restart restart = Restart::if_asked;
};
Patience patience_of(int descriptor, DescriptorClass of, short events) {
  timeval span_of_time{};
  socklen_t size = sizeof span_of_time;
  const ErrorNumberKept kept;
  const int option = events == POLLIN ? SO_RCVTIMEO : SO_SNDTIMEO;
  if (of != DescriptorClass::socket ||
      WAITPOINT_NEXT(getsockopt)(descriptor, SOL_SOCKET, option, &span_of_time, &size) != 0 ||
      (span_of_time.tv_sec == 0 && span_of_time.tv_usec == 0))
    return {};
  const Duration patience = span({span_of_time.tv_sec, span_of_time.tv_usec * 1000});
  return {later(kernel::local_time(*kernel::running), patience), Restart::never};
}

}  // namespace

DescriptorClass class_of(int descriptor) {
  if (!is_simulated()) return DescriptorClass::file;
  if (is_counted_pipe(descriptor)) return DescriptorClass::pipe;
  struct stat of {};
  const ErrorNumberKept kept;
  const bool known = WAITPOINT_NEXT(fstat)(descriptor, &of) == 0;
  if (!known || S_ISREG(of.st_mode) || S_ISDIR(of.st_mode) || S_ISBLK(of.st_mode)) return DescriptorClass::file;
  return S_ISFIFO(of.st_mode)   ? DescriptorClass::pipe
         : S_ISSOCK(of.st_mode) ? DescriptorClass::socket
                                : DescriptorClass::other;
}

bool blocks(int descriptor) { return (WAITPOINT_NEXT(fcntl)(descriptor, F_GETFL) & O_NONBLOCK) == 0; }

bool may_wait_for(int descriptor, short events) {
  if (counted_pipe(descriptor, events) != nullptr) return true;
  const int flags = WAITPOINT_NEXT(fcntl)(descriptor, F_GETFL);
  return (flags & O_NONBLOCK) == 0 && (flags & O_ACCMODE) != (events == POLLIN ? O_WRONLY : O_RDONLY);
}

long read_at_once(int descriptor, void* bytes, std::size_t size) {
  const long count = call_directly(SYS_read, descriptor, reinterpret_cast<long>(bytes), static_cast<long>(size));
  if (count > 0) note_read(counted_pipe(descriptor, POLLIN), static_cast<std::size_t>(count));
  return count;
}

long write_at_once(int descriptor, const void* bytes, std::size_t size) {
  InsideFile* const pipe = counted_pipe(descriptor, POLLOUT);
  // A pipe that is ready has room for PIPE_BUF bytes.
  const std::size_t room = std::max<std::size_t>(pipe != nullptr ? room_in(*pipe) : 0, PIPE_BUF);
  const bool is_pipe = pipe != nullptr || class_of(descriptor) == DescriptorClass::pipe;
  const std::size_t piece = is_pipe ? std::min(size, room) : size;
  const long count = call_directly(SYS_write, descriptor, reinterpret_cast<long>(bytes), static_cast<long>(piece));
  if (count > 0) note_written(pipe, static_cast<std::size_t>(count));
  return count;
}

bool prepare(int descriptor, DescriptorClass of, kernel::Operation operation, short events, bool may_block) {
  WAITPOINT_CHECK(of != DescriptorClass::file && descriptor >= 0, "a file is to be waited for, or no descriptor");
  WAITPOINT_CHECK(events == POLLIN || events == POLLOUT, "a transfer has no direction");
  const CancellationPoint point;
  pass(operation, nullptr);
  // The reader of a loopback stream is mostly a thread, which needs a turn.
  const int patience_ms = sends_at_once(descriptor) ? 0 : patience_with_readers_ms;
  if (may_block && events == POLLOUT && !is_inside(descriptor) && wait_for_reader(descriptor, patience_ms)) return true;
  bool is_ready = true;
  if (may_block && may_wait_for(descriptor, events)) {
    const Patience patience = patience_of(descriptor, of, events);
    const int ready = wait_for(descriptor, events, patience.deadline, patience.restart);
    leave_if_cancelled();
    if (ready == 0) errno = EAGAIN;
    is_ready = ready > 0;
  }
  leave_if_cancelled();
  return is_ready;
}

}  // namespace waitpoint::posix
