// SPDX-License-Identifier: BSD-3-Clause
//
// Reading, writing, sending, receiving: where the system would block the thread, it waits for the descriptor first.
#include <fcntl.h>
#include <limits.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>

#include "fibers/kernel/sanitizer.hpp"
#include "fibers/posix/cancellation.hpp"
#include "fibers/posix/clocks.hpp"
#include "fibers/posix/descriptors.hpp"
#include "fibers/posix/error_number.hpp"
#include "fibers/posix/interposed.hpp"
#include "fibers/posix/signal_descriptors.hpp"
#include "fibers/posix/timer_descriptors.hpp"
#include "fibers/posix/waiting.hpp"

namespace waitpoint::posix {
namespace {

enum class Class { file, pipe, socket, other };

// Files are always ready, and their use is no event.
Class class_of(int descriptor) {
  struct stat of {};
  const ErrorNumberKept kept;
  const bool known = fstat(descriptor, &of) == 0;
  if (!known || S_ISREG(of.st_mode) || S_ISDIR(of.st_mode) || S_ISBLK(of.st_mode)) return Class::file;
  return S_ISFIFO(of.st_mode) ? Class::pipe : S_ISSOCK(of.st_mode) ? Class::socket : Class::other;
}

bool blocks(int descriptor) { return (fcntl(descriptor, F_GETFL) & O_NONBLOCK) == 0; }

// Whoever reads outside what is written mostly needs nothing but time, which is none of ours. But it may wait for
// another thread of this program.
constexpr int patience_with_readers_ms = 1000;

// Until when a socket is waited for: it may have been given a time for that. A signal's handler ends such a wait in any
// case.
struct Patience {
  Time deadline = Time::max();
  Restart restart = Restart::if_asked;
};
Patience patience_of(int descriptor, Class of, short events) {
  timeval span_of_time{};
  socklen_t size = sizeof span_of_time;
  const ErrorNumberKept kept;
  const int option = events == POLLIN ? SO_RCVTIMEO : SO_SNDTIMEO;
  if (of != Class::socket || getsockopt(descriptor, SOL_SOCKET, option, &span_of_time, &size) != 0 ||
      (span_of_time.tv_sec == 0 && span_of_time.tv_usec == 0))
    return {};
  const Duration patience = span({span_of_time.tv_sec, span_of_time.tv_usec * 1000});
  return {later(kernel::local_time(*kernel::running), patience), Restart::never};
}

// Before a call that may block on `descriptor`: its event, and the wait. False, with errno set, if the call has failed.
bool prepare(int descriptor, Class of, kernel::Operation operation, short events, bool may_block) {
  const CancellationPoint point;
  pass(operation, nullptr);
  if (may_block && events == POLLOUT && !is_inside(descriptor) && wait_for_reader(descriptor, patience_with_readers_ms))
    return true;
  bool is_ready = true;
  if (may_block && blocks(descriptor)) {
    const Patience patience = patience_of(descriptor, of, events);
    const int ready = wait_for(descriptor, events, patience.deadline, patience.restart);
    leave_if_cancelled();
    if (ready == 0) errno = EAGAIN;
    is_ready = ready > 0;
  }
  leave_if_cancelled();
  return is_ready;
}

// All that is sent and received, to whoever looks for races: what was sent happens before what follows its reception,
// and whose it was, the system knows.
constexpr char descriptors = 0;

// The call, and a look at who may go on by it.
template <class Call>
auto done(Call call) {
  if (kernel::sanitizer::present) kernel::sanitizer::release(&descriptors);
  const auto result = call();
  if (kernel::sanitizer::present) kernel::sanitizer::acquire(&descriptors);
  look_at_descriptors();
  return result;
}

template <class Call>
auto receive(int descriptor, bool may_block, Call call) {
  const Class of = is_simulated() ? class_of(descriptor) : Class::file;
  if (of == Class::file) return call();
  if (!prepare(descriptor, of, kernel::Operation::receive, POLLIN, may_block)) return static_cast<decltype(call())>(-1);
  return done(call);
}

template <class Call>
auto send_all_at_once(int descriptor, bool may_block, Call call) {
  const Class of = is_simulated() ? class_of(descriptor) : Class::file;
  if (of == Class::file) return call();
  if (!prepare(descriptor, of, kernel::Operation::send, POLLOUT, may_block)) return static_cast<decltype(call())>(-1);
  return done(call);
}

// A pipe or a stream socket that can take something may not be able to take all: piece by piece, as much as it takes.
ssize_t write_all(int descriptor, Class of, const char* bytes, std::size_t size) {
  std::size_t written = 0;
  do {
    if (!prepare(descriptor, of, kernel::Operation::send, POLLOUT, true))
      return written > 0 ? static_cast<ssize_t>(written) : -1;
    const std::size_t left = size - written;
    const ssize_t count = done([&] {
      if (of == Class::socket) return WAITPOINT_NEXT(send)(descriptor, bytes + written, left, MSG_DONTWAIT);
      // What is ready takes as much as is atomic.
      const std::size_t piece = of == Class::pipe && left > PIPE_BUF ? PIPE_BUF : left;
      return WAITPOINT_NEXT(write)(descriptor, bytes + written, piece);
    });
    if (count < 0 && errno == EAGAIN) continue;
    if (count < 0) return written > 0 ? static_cast<ssize_t>(written) : -1;
    written += static_cast<std::size_t>(count);
  } while (written < size);
  return static_cast<ssize_t>(written);
}

bool is_stream(int descriptor) {
  int type = 0;
  socklen_t size = sizeof type;
  return getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) == 0 && type == SOCK_STREAM;
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED ssize_t read(int descriptor, void* bytes, std::size_t size) {
  if (is_simulated()) bring_up_to_date(descriptor);
  if (is_simulated() && is_signal_descriptor(descriptor))
    return receive(descriptor, true, [&] { return read_signals(descriptor, bytes, size); });
  return receive(descriptor, true, [&] { return WAITPOINT_NEXT(read)(descriptor, bytes, size); });
}

WAITPOINT_INTERPOSED ssize_t readv(int descriptor, const iovec* pieces, int count) {
  return receive(descriptor, true, [&] { return WAITPOINT_NEXT(readv)(descriptor, pieces, count); });
}

WAITPOINT_INTERPOSED ssize_t recv(int descriptor, void* bytes, std::size_t size, int flags) {
  return receive(descriptor, (flags & MSG_DONTWAIT) == 0,
                 [&] { return WAITPOINT_NEXT(recv)(descriptor, bytes, size, flags); });
}

WAITPOINT_INTERPOSED ssize_t recvfrom(int descriptor, void* __restrict bytes, std::size_t size, int flags,
                                      sockaddr* __restrict address, socklen_t* __restrict length) {
  return receive(descriptor, (flags & MSG_DONTWAIT) == 0,
                 [&] { return WAITPOINT_NEXT(recvfrom)(descriptor, bytes, size, flags, address, length); });
}

WAITPOINT_INTERPOSED ssize_t recvmsg(int descriptor, msghdr* message, int flags) {
  return receive(descriptor, (flags & MSG_DONTWAIT) == 0,
                 [&] { return WAITPOINT_NEXT(recvmsg)(descriptor, message, flags); });
}

WAITPOINT_INTERPOSED int accept4(int descriptor, sockaddr* __restrict address, socklen_t* __restrict length,
                                 int flags) {
  const int made =
      receive(descriptor, true, [&] { return WAITPOINT_NEXT(accept4)(descriptor, address, length, flags); });
  if (made >= 0) note_inside(made, is_inside(descriptor));
  note_owner(made);
  return made;
}

WAITPOINT_INTERPOSED int accept(int descriptor, sockaddr* __restrict address, socklen_t* __restrict length) {
  return accept4(descriptor, address, length, 0);
}

WAITPOINT_INTERPOSED ssize_t write(int descriptor, const void* bytes, std::size_t size) {
  const Class of = is_simulated() ? class_of(descriptor) : Class::file;
  const bool in_pieces = size > 0 && (of == Class::pipe || (of == Class::socket && is_stream(descriptor)));
  if (in_pieces && blocks(descriptor)) return write_all(descriptor, of, static_cast<const char*>(bytes), size);
  return send_all_at_once(descriptor, true, [&] { return WAITPOINT_NEXT(write)(descriptor, bytes, size); });
}

WAITPOINT_INTERPOSED ssize_t writev(int descriptor, const iovec* pieces, int count) {
  const Class of = is_simulated() ? class_of(descriptor) : Class::file;
  if (of == Class::file || of == Class::other || !blocks(descriptor))
    return send_all_at_once(descriptor, true, [&] { return WAITPOINT_NEXT(writev)(descriptor, pieces, count); });
  ssize_t all = 0;
  for (int i = 0; i < count; ++i) {
    const ssize_t written = write(descriptor, pieces[i].iov_base, pieces[i].iov_len);
    if (written < 0) return all > 0 ? all : -1;
    all += written;
    if (static_cast<std::size_t>(written) < pieces[i].iov_len) break;
  }
  return all;
}

WAITPOINT_INTERPOSED ssize_t send(int descriptor, const void* bytes, std::size_t size, int flags) {
  if (flags == 0 && is_simulated() && class_of(descriptor) == Class::socket) return write(descriptor, bytes, size);
  return send_all_at_once(descriptor, (flags & MSG_DONTWAIT) == 0,
                          [&] { return WAITPOINT_NEXT(send)(descriptor, bytes, size, flags); });
}

WAITPOINT_INTERPOSED ssize_t sendto(int descriptor, const void* bytes, std::size_t size, int flags,
                                    const sockaddr* address, socklen_t length) {
  return send_all_at_once(descriptor, (flags & MSG_DONTWAIT) == 0,
                          [&] { return WAITPOINT_NEXT(sendto)(descriptor, bytes, size, flags, address, length); });
}

WAITPOINT_INTERPOSED ssize_t sendmsg(int descriptor, const msghdr* message, int flags) {
  return send_all_at_once(descriptor, (flags & MSG_DONTWAIT) == 0,
                          [&] { return WAITPOINT_NEXT(sendmsg)(descriptor, message, flags); });
}

WAITPOINT_INTERPOSED int shutdown(int descriptor, int how) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(shutdown)(descriptor, how);
  pass(kernel::Operation::close, nullptr);
  return done([&] { return WAITPOINT_NEXT(shutdown)(descriptor, how); });
}

WAITPOINT_INTERPOSED int connect(int descriptor, const sockaddr* address, socklen_t length) {
  if (!is_simulated()) return WAITPOINT_NEXT(connect)(descriptor, address, length);
  pass(kernel::Operation::connect, nullptr);
  return done([&] { return WAITPOINT_NEXT(connect)(descriptor, address, length); });
}
