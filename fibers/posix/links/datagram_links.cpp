// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/links/datagram_links.hpp"

#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/links/robot_links.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

/// Larger ones are left to the system, which rejects them.
constexpr std::size_t largest_datagram = std::size_t{1} << 30;

/// A datagram under way; its bytes follow the record. `descriptor` is our duplicate of the sending socket's.
struct Datagram {
  int descriptor;
  SocketAddress to;
  std::size_t size;
  char* bytes() { return reinterpret_cast<char*>(this + 1); }
};

void arrive_datagram(void* message) {
  auto& datagram = *static_cast<Datagram*>(message);
  WAITPOINT_CHECK(datagram.descriptor >= 0 && datagram.to.length <= sizeof datagram.to.bytes,
                  "a datagram arrives without a socket or a destination");
  const ErrorNumberKept kept;
  WAITPOINT_NEXT(sendto)
  (datagram.descriptor, datagram.bytes(), datagram.size, MSG_DONTWAIT | MSG_NOSIGNAL, datagram.to.get(),
   datagram.to.length);
  look_at_descriptors();
}

void drop_datagram(void* message) {
  const ErrorNumberKept kept;
  WAITPOINT_NEXT(close)(static_cast<Datagram*>(message)->descriptor);
  std::free(message);
}

// The destination; false without one.
bool take_target(int descriptor, const sockaddr* to, socklen_t length, SocketAddress& address) {
  if (to == nullptr) return take_peers_address(descriptor, address);
  if (length > sizeof address.bytes) return false;
  std::memcpy(&address.bytes, to, length);
  address.length = length;
  return true;
}

}  // namespace

bool send_over_link(int descriptor, const msghdr& message, std::size_t& size) {
  const Carrier* const carrier = carrier_here();
  if (carrier == nullptr || type_of_socket(descriptor) != SOCK_DGRAM || message.msg_controllen > 0) return false;
  const ErrorNumberKept kept;
  SocketAddress address;
  if (!take_target(descriptor, static_cast<const sockaddr*>(message.msg_name), message.msg_namelen, address))
    return false;
  const void* const receiver = receiver_at(address, SOCK_DGRAM, nullptr);
  if (receiver == nullptr) return false;
  size = 0;
  for (std::size_t i = 0; i < message.msg_iovlen; ++i)
    if (__builtin_add_overflow(size, message.msg_iov[i].iov_len, &size) || size > largest_datagram) return false;
  auto* const memory = static_cast<Datagram*>(std::malloc(sizeof(Datagram) + size));
  const int copy = WAITPOINT_NEXT(fcntl)(descriptor, F_DUPFD_CLOEXEC, 0);
  if (memory == nullptr || copy < 0) {
    std::free(memory);
    return false;
  }
  auto* const datagram = new (memory) Datagram{copy, address, size};
  char* at = datagram->bytes();
  for (std::size_t i = 0; i < message.msg_iovlen; ++i) {
    std::memcpy(at, message.msg_iov[i].iov_base, message.msg_iov[i].iov_len);
    at += message.msg_iov[i].iov_len;
  }
  WAITPOINT_CHECK(at == datagram->bytes() + size, "the parts of a datagram have another size than their sum");
  pass(kernel::Operation::send, nullptr);
  if (carrier->carry(carrier->network, *this_program().robot, receiver, size, arrive_datagram, drop_datagram, datagram))
    return true;
  drop_datagram(datagram);
  return false;
}

bool send_over_link(int descriptor, const void* bytes, std::size_t size, const sockaddr* to, socklen_t length) {
  iovec part{const_cast<void*>(bytes), size};
  msghdr message{};
  message.msg_name = const_cast<sockaddr*>(to);
  message.msg_namelen = length;
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  return send_over_link(descriptor, message, size);
}

}  // namespace waitpoint::posix
