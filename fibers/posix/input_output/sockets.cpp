// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/input_output/sockets.hpp"

#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "core/error.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/real_waits.hpp"
#include "fibers/posix/descriptors/connections.hpp"
#include "fibers/posix/descriptors/owners.hpp"
#include "fibers/posix/descriptors/partners.hpp"
#include "fibers/posix/input_output/chosen_ports.hpp"
#include "fibers/posix/input_output/input_output.hpp"
#include "fibers/posix/links/datagram_links.hpp"
#include "fibers/posix/links/datagram_medium.hpp"
#include "fibers/posix/links/loopback.hpp"
#include "fibers/posix/links/robot_links.hpp"
#include "fibers/posix/links/stream_links.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/repeatability.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

int option_of(int descriptor, int option) {
  int value = 0;
  socklen_t size = sizeof value;
  const ErrorNumberKept kept;
  return WAITPOINT_NEXT(getsockopt)(descriptor, SOL_SOCKET, option, &value, &size) == 0 ? value : -1;
}

// True for internet addresses beyond this machine's loopback.
bool leaves(const sockaddr* address) {
  if (address == nullptr || record->settings.own_machine) return false;
  if (address->sa_family == AF_INET) {
    const auto& internet = *reinterpret_cast<const sockaddr_in*>(address);
    const std::uint32_t host = ntohl(internet.sin_addr.s_addr);
    return host >> 24 != 127 && host != INADDR_ANY;
  }
  if (address->sa_family == AF_INET6) {
    const in6_addr& host = reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr;
    if (IN6_IS_ADDR_V4MAPPED(&host)) return host.s6_addr[12] != 127;
    return !IN6_IS_ADDR_LOOPBACK(&host) && !IN6_IS_ADDR_UNSPECIFIED(&host);
  }
  return false;
}

// Reports the first rejection only.
bool is_forbidden(const sockaddr* address) {
  static bool is_told = false;
  if (!is_simulated() || !leaves(address)) return false;
  note_unrepeatable("traffic beyond this machine");
  if (!record->settings.isolate) return false;
  if (!is_told) std::fprintf(stderr, "waitpoint: exec: --isolate: traffic beyond this machine is rejected (EACCES)\n");
  is_told = true;
  errno = EACCES;
  return true;
}

// Receives `size` bytes of a stream, or up to its end.
ssize_t receive_all(int descriptor, char* bytes, std::size_t size, int flags) {
  std::size_t received = 0;
  while (received < size) {
    if (!prepare(descriptor, DescriptorClass::socket, kernel::Operation::receive, POLLIN, true)) break;
    const ssize_t count = done([&] {
      const int now = (flags & ~MSG_WAITALL) | MSG_DONTWAIT;
      return WAITPOINT_NEXT(recv)(descriptor, bytes + received, size - received, now);
    });
    if (count < 0 && errno == EAGAIN) continue;
    if (count < 0) break;
    if (count == 0) return static_cast<ssize_t>(received);
    WAITPOINT_CHECK(static_cast<std::size_t>(count) <= size - received, "more was received than there is room for");
    acknowledge(descriptor);
    received += static_cast<std::size_t>(count);
  }
  return received > 0 || size == 0 ? static_cast<ssize_t>(received) : -1;
}

// The same into the parts of a message. Ancillary data comes with the first part; if there is any, the call returns.
ssize_t receive_all_parts(int descriptor, msghdr& message, int flags) {
  ssize_t received = -1;
  for (std::size_t i = 0; i < message.msg_iovlen; ++i) {
    const iovec& part = message.msg_iov[i];
    if (part.iov_len == 0) continue;
    std::size_t filled = 0;
    if (received < 0) {
      iovec* const parts = message.msg_iov;
      const std::size_t count = std::exchange(message.msg_iovlen, 1);
      message.msg_iov = &parts[i];
      received = receive(descriptor, true,
                         [&] { return WAITPOINT_NEXT(recvmsg)(descriptor, &message, flags & ~MSG_WAITALL); });
      message.msg_iov = parts;
      message.msg_iovlen = count;
      if (received <= 0 || message.msg_controllen > 0) return received;
      filled = static_cast<std::size_t>(received);
      WAITPOINT_CHECK(filled <= part.iov_len, "more was received than the first part has room for");
      if (filled == part.iov_len) continue;
    }
    const std::size_t left = part.iov_len - filled;
    const ssize_t more = receive_all(descriptor, static_cast<char*>(part.iov_base) + filled, left, flags);
    if (more > 0) received += more;
    if (more < static_cast<ssize_t>(left)) return received;
  }
  return received < 0 ? 0 : received;
}

// Calls fail at once for a descriptor that is no socket, and never wait for out-of-band data or the error queue.
bool may_block(int descriptor, int flags) {
  return (flags & (MSG_DONTWAIT | MSG_OOB | MSG_ERRQUEUE)) == 0 && class_of(descriptor) == DescriptorClass::socket;
}

bool waits_for_all(int descriptor, int flags) {
  return (flags & MSG_WAITALL) != 0 && (flags & (MSG_DONTWAIT | MSG_PEEK)) == 0 && is_simulated() &&
         class_of(descriptor) == DescriptorClass::socket && is_stream(descriptor) && blocks(descriptor);
}

// Sends a message as a whole. An unconnected socket does not show whether the receiver has room: then the call is
// repeated after a pause.
template <class Call>
ssize_t send_message(int descriptor, int flags, Call call) {
  const DescriptorClass of = class_of(descriptor);
  if (of == DescriptorClass::file) return call(flags);
  const bool waits = may_block(descriptor, flags) && blocks(descriptor);
  Duration pause = Duration(std::chrono::microseconds(1));
  constexpr Duration longest_pause = Duration(std::chrono::milliseconds(1));
  for (;;) {
    if (!prepare(descriptor, of, kernel::Operation::send, POLLOUT, waits)) return -1;
    const ssize_t sent = done([&] { return call(flags | MSG_DONTWAIT); });
    if (sent >= 0 || errno != EAGAIN || !waits) return sent;
    const CancellationPoint point;
    if (!point.wait_until(later(kernel::local_time(*kernel::running), pause))) return fail(EINTR);
    if (pause < longest_pause) pause = pause + pause;
  }
}

// A datagram that stays on this machine, to the address or, without one, to the socket's peer.
bool send_through_medium_of_machine(int descriptor, const msghdr& message, std::size_t& size) {
  if (!is_simulated() || has_host || !record->settings.medium.is_declared()) return false;
  SocketAddress peer;
  const auto* to = static_cast<const sockaddr*>(message.msg_name);
  if (to == nullptr && take_peers_address(descriptor, peer)) to = peer.get();
  return !leaves(to) && send_through_medium(descriptor, message, size);
}

// Of one part, without ancillary data.
bool send_through_medium_of_machine(int descriptor, const void* bytes, std::size_t size, const sockaddr* to,
                                    socklen_t length) {
  iovec part{const_cast<void*>(bytes), size};
  msghdr message{};
  message.msg_name = const_cast<sockaddr*>(to);
  message.msg_namelen = to != nullptr ? length : 0;
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  return send_through_medium_of_machine(descriptor, message, size);
}

ssize_t send_parts_over_link(int descriptor, const msghdr& message) {
  ssize_t all = 0;
  for (std::size_t i = 0; i < message.msg_iovlen; ++i) {
    const iovec& part = message.msg_iov[i];
    const ssize_t sent = part.iov_len == 0 ? 0 : send_stream_over_link(descriptor, part.iov_base, part.iov_len);
    if (sent < 0) return all > 0 ? all : -1;
    all += sent;
    if (static_cast<std::size_t>(sent) < part.iov_len) break;
  }
  return all;
}

// Sends the parts in pieces; ancillary data goes with the first.
ssize_t send_parts(int descriptor, const msghdr& message, int flags) {
  ssize_t all = 0;
  bool is_first = true;
  for (std::size_t i = 0; i < message.msg_iovlen; ++i) {
    const iovec& part = message.msg_iov[i];
    if (part.iov_len == 0) continue;
    const auto take = [&](const char* bytes, std::size_t size) {
      iovec piece{const_cast<char*>(bytes), size};
      msghdr of_piece = message;
      of_piece.msg_iov = &piece;
      of_piece.msg_iovlen = 1;
      if (!is_first) of_piece.msg_control = nullptr, of_piece.msg_controllen = 0;
      const ssize_t sent = WAITPOINT_NEXT(sendmsg)(descriptor, &of_piece, flags | MSG_DONTWAIT);
      is_first = is_first && sent < 0;
      return sent;
    };
    const ssize_t sent =
        write_all(descriptor, DescriptorClass::socket, static_cast<const char*>(part.iov_base), part.iov_len, take);
    if (sent < 0) return all > 0 ? all : -1;
    all += sent;
    if (static_cast<std::size_t>(sent) < part.iov_len) break;
  }
  return all;
}

void note_received_descriptors(msghdr& message) {
  for (cmsghdr* head = CMSG_FIRSTHDR(&message); head != nullptr; head = CMSG_NXTHDR(&message, head)) {
    if (head->cmsg_level != SOL_SOCKET || head->cmsg_type != SCM_RIGHTS) continue;
    for (std::size_t at = CMSG_LEN(0); at + sizeof(int) <= head->cmsg_len; at += sizeof(int)) {
      int descriptor = -1;
      std::memcpy(&descriptor, reinterpret_cast<char*>(head) + at, sizeof descriptor);
      note_received(descriptor);
    }
  }
}

bool has_bytes(const msghdr& message) {
  for (std::size_t i = 0; i < message.msg_iovlen; ++i)
    if (message.msg_iov[i].iov_len > 0) return true;
  return false;
}

// Over the loopback a connection is made, or refused, at once, but on a loaded machine the system's part of it can be
// late: it is waited for in real time.
int made_over_loopback(int descriptor, int result) {
  if (result == 0) return note_connected(descriptor), 0;
  if (errno != EINPROGRESS || !sends_at_once(descriptor)) return result;
  const ErrorNumberKept kept;
  const RealWait real;
  constexpr int patience_ms = 200;
  pollfd one{descriptor, POLLOUT, 0};
  WAITPOINT_NEXT(poll)(&one, 1, patience_ms);
  note_connected(descriptor);
  return result;
}

// The system's call without waiting, even on a blocking socket.
int connect_at_once(int descriptor, const sockaddr* address, socklen_t length) {
  const int flags = WAITPOINT_NEXT(fcntl)(descriptor, F_GETFL);
  WAITPOINT_NEXT(fcntl)(descriptor, F_SETFL, flags | O_NONBLOCK);
  const int result = WAITPOINT_NEXT(connect)(descriptor, address, length);
  const ErrorNumberKept kept;
  WAITPOINT_NEXT(fcntl)(descriptor, F_SETFL, flags);
  return result;
}

int connect_and_wait(int descriptor, const sockaddr* address, socklen_t length) {
  const CancellationPoint point;
  for (;;) {
    const int result = done([&] {
      const int made = connect_at_once(descriptor, address, length);
      note_connecting(descriptor);
      return made_over_loopback(descriptor, made);
    });
    if (result == 0 || (errno != EINPROGRESS && errno != EAGAIN)) return result;
    if (errno == EINPROGRESS) break;
    // EAGAIN, of a local socket: the listener's queue is full.
    if (!point.wait_until(later(kernel::local_time(*kernel::running), std::chrono::microseconds(100))))
      return fail(EINTR);
  }
  const int ready = wait_for(descriptor, POLLOUT, Time::max(), Restart::if_asked);
  leave_if_cancelled();
  if (ready < 0) return -1;
  // A second call reports the result, and leaves the socket as a blocking connect() does.
  return done([&] { return connect_at_once(descriptor, address, length); });
}

}  // namespace

bool is_stream(int descriptor) { return option_of(descriptor, SO_TYPE) == SOCK_STREAM; }

ssize_t send_to_stream(int descriptor, const void* bytes, std::size_t size, int flags) {
  if (goes_over_link(descriptor)) return send_stream_over_link(descriptor, bytes, size);
  if ((flags & MSG_DONTWAIT) != 0 || !blocks(descriptor))
    return send_all_at_once(descriptor, false, [&] { return WAITPOINT_NEXT(send)(descriptor, bytes, size, flags); });
  const auto take = [&](const char* at, std::size_t left) {
    return WAITPOINT_NEXT(send)(descriptor, at, left, flags | MSG_DONTWAIT);
  };
  return write_all(descriptor, DescriptorClass::socket, static_cast<const char*>(bytes), size, take);
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED ssize_t recv(int descriptor, void* bytes, std::size_t size, int flags) {
  if (waits_for_all(descriptor, flags)) return receive_all(descriptor, static_cast<char*>(bytes), size, flags);
  return receive(descriptor, may_block(descriptor, flags),
                 [&] { return WAITPOINT_NEXT(recv)(descriptor, bytes, size, flags); });
}

WAITPOINT_INTERPOSED ssize_t recvfrom(int descriptor, void* __restrict bytes, std::size_t size, int flags,
                                      sockaddr* __restrict address, socklen_t* __restrict length) {
  if (address == nullptr) return recv(descriptor, bytes, size, flags);
  const bool waits = waits_for_all(descriptor, flags);
  const int now = waits ? flags & ~MSG_WAITALL : flags;
  const ssize_t received = receive(descriptor, may_block(descriptor, flags), [&] {
    return WAITPOINT_NEXT(recvfrom)(descriptor, bytes, size, now, address, length);
  });
  if (!waits || received <= 0 || static_cast<std::size_t>(received) == size) return received;
  const auto before = static_cast<std::size_t>(received);
  WAITPOINT_CHECK(before < size, "more was received than there is room for");
  const ssize_t more = receive_all(descriptor, static_cast<char*>(bytes) + before, size - before, flags);
  return more > 0 ? received + more : received;
}

WAITPOINT_INTERPOSED ssize_t recvmsg(int descriptor, msghdr* message, int flags) {
  const AlsoUsing descriptors(changing(place::descriptors));  // of SCM_RIGHTS
  if (waits_for_all(descriptor, flags) && can_be_read(message) && has_bytes(*message))
    return receive_all_parts(descriptor, *message, flags);
  const ssize_t received = receive(descriptor, may_block(descriptor, flags),
                                   [&] { return WAITPOINT_NEXT(recvmsg)(descriptor, message, flags); });
  if (received >= 0) note_received_descriptors(*message);
  return received;
}

WAITPOINT_INTERPOSED ssize_t send(int descriptor, const void* bytes, std::size_t size, int flags) {
  if (class_of(descriptor) == DescriptorClass::socket && is_stream(descriptor) && size > 0)
    return send_to_stream(descriptor, bytes, size, flags);
  if (send_over_link(descriptor, bytes, size, nullptr, 0)) return static_cast<ssize_t>(size);
  if (send_through_medium_of_machine(descriptor, bytes, size, nullptr, 0)) return static_cast<ssize_t>(size);
  return send_message(descriptor, flags, [&](int with) { return WAITPOINT_NEXT(send)(descriptor, bytes, size, with); });
}

WAITPOINT_INTERPOSED ssize_t sendto(int descriptor, const void* bytes, std::size_t size, int flags,
                                    const sockaddr* address, socklen_t length) {
  if (is_forbidden(address)) return -1;
  if (address == nullptr) return send(descriptor, bytes, size, flags);
  bind_to_next_port(descriptor);
  if (send_over_link(descriptor, bytes, size, address, length)) return static_cast<ssize_t>(size);
  if (send_through_medium_of_machine(descriptor, bytes, size, address, length)) return static_cast<ssize_t>(size);
  return send_message(descriptor, flags,
                      [&](int with) { return WAITPOINT_NEXT(sendto)(descriptor, bytes, size, with, address, length); });
}

WAITPOINT_INTERPOSED ssize_t sendmsg(int descriptor, const msghdr* message, int flags) {
  if (!can_be_read(message)) return WAITPOINT_NEXT(sendmsg)(descriptor, message, flags);
  if (is_forbidden(static_cast<const sockaddr*>(message->msg_name))) return -1;
  if (message->msg_controllen > 0) end_counting_of_all();  // of which it may pass duplicates
  bind_to_next_port(descriptor);
  std::size_t size = 0;
  if (send_over_link(descriptor, *message, size)) return static_cast<ssize_t>(size);
  if (send_through_medium_of_machine(descriptor, *message, size)) return static_cast<ssize_t>(size);
  if (goes_over_link(descriptor)) return send_parts_over_link(descriptor, *message);
  if (class_of(descriptor) == DescriptorClass::socket && is_stream(descriptor) && has_bytes(*message) &&
      (flags & MSG_DONTWAIT) == 0 && blocks(descriptor))
    return send_parts(descriptor, *message, flags);
  return send_message(descriptor, flags, [&](int with) { return WAITPOINT_NEXT(sendmsg)(descriptor, message, with); });
}

WAITPOINT_INTERPOSED int accept4(int descriptor, sockaddr* __restrict address, socklen_t* __restrict length,
                                 int flags) {
  const AlsoUsing descriptors(changing(place::descriptors));
  const bool is_valid = (flags & ~(SOCK_NONBLOCK | SOCK_CLOEXEC)) == 0 && option_of(descriptor, SO_ACCEPTCONN) == 1;
  const int made =
      receive(descriptor, is_valid, [&] { return WAITPOINT_NEXT(accept4)(descriptor, address, length, flags); });
  if (made >= 0) note_inside(made, is_inside(descriptor)), copy_asked(descriptor, made), note_accepted(descriptor);
  note_owner(made);
  return made;
}

WAITPOINT_INTERPOSED int accept(int descriptor, sockaddr* __restrict address, socklen_t* __restrict length) {
  return accept4(descriptor, address, length, 0);
}

WAITPOINT_INTERPOSED int shutdown(int descriptor, int how) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(shutdown)(descriptor, how);
  pass(kernel::Operation::close, nullptr);
  if ((how == SHUT_WR || how == SHUT_RDWR) && end_stream_over_link(descriptor)) {
    if (how == SHUT_WR) return 0;
    how = SHUT_RD;
  }
  return done([&] { return WAITPOINT_NEXT(shutdown)(descriptor, how); });
}

WAITPOINT_INTERPOSED int connect(int descriptor, const sockaddr* address, socklen_t length) {
  if (!is_simulated()) return WAITPOINT_NEXT(connect)(descriptor, address, length);
  if (is_forbidden(address)) return -1;
  if (can_be_read(address) && !leaves(address)) send_at_once(descriptor);
  bind_to_next_port(descriptor);
  pass(kernel::Operation::connect, nullptr);
  const bool waits = class_of(descriptor) == DescriptorClass::socket && blocks(descriptor);
  forget_connection(descriptor);
  if (waits) return connect_and_wait(descriptor, address, length);
  return done([&] {
    const int result = WAITPOINT_NEXT(connect)(descriptor, address, length);
    note_connecting(descriptor);
    return made_over_loopback(descriptor, result);
  });
}
