// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/datagram_links.hpp"

#include <fcntl.h>
#include <netinet/in.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>

#include "fibers/posix/descriptors.hpp"
#include "fibers/posix/error_number.hpp"
#include "fibers/posix/interposed.hpp"
#include "fibers/posix/program.hpp"

namespace waitpoint::posix {
namespace {

const Carrier* carrier = nullptr;

struct Address {
  sockaddr_storage bytes;
  socklen_t length;
};

/// On its way: the socket that sent it, by a descriptor of our own, and the bytes behind it.
struct Datagram {
  int descriptor;
  Address to;
  std::size_t size;
  char* bytes() { return reinterpret_cast<char*>(this + 1); }
};

bool is_datagram_socket(int descriptor) {
  int type = 0;
  socklen_t size = sizeof type;
  return getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) == 0 && type == SOCK_DGRAM;
}

// What is bound to any address of the machine is met at each.
bool is_at(const Address& bound, const Address& address) {
  if (bound.bytes.ss_family != address.bytes.ss_family) return false;
  if (address.bytes.ss_family != AF_INET)
    return bound.length == address.length && std::memcmp(&bound.bytes, &address.bytes, address.length) == 0;
  const auto& here = reinterpret_cast<const sockaddr_in&>(bound.bytes);
  const auto& there = reinterpret_cast<const sockaddr_in&>(address.bytes);
  return here.sin_port == there.sin_port &&
         (here.sin_addr.s_addr == there.sin_addr.s_addr || here.sin_addr.s_addr == htonl(INADDR_ANY));
}

// Null if it is of no program, or of one of the same robot.
const Program* receiver_of(const Address& to) {
  const Program* owner = nullptr;
  for (int at = next_owned(0, owner); at >= 0; at = next_owned(at + 1, owner)) {
    Address bound{{}, sizeof bound.bytes};
    if (owner->robot == this_program().robot || !is_datagram_socket(at)) continue;
    if (getsockname(at, reinterpret_cast<sockaddr*>(&bound.bytes), &bound.length) == 0 && is_at(bound, to))
      return owner;
  }
  return nullptr;
}

void arrive(void* message) {
  auto& datagram = *static_cast<Datagram*>(message);
  const ErrorNumberKept kept;
  WAITPOINT_NEXT(sendto)
  (datagram.descriptor, datagram.bytes(), datagram.size, MSG_DONTWAIT | MSG_NOSIGNAL,
   reinterpret_cast<sockaddr*>(&datagram.to.bytes), datagram.to.length);
  look_at_descriptors();
}

void drop(void* message) {
  const ErrorNumberKept kept;
  WAITPOINT_NEXT(close)(static_cast<Datagram*>(message)->descriptor);
  std::free(message);
}

}  // namespace

void set_carrier(const Carrier* to) { carrier = to; }

bool send_over_link(int descriptor, const void* bytes, std::size_t size, const sockaddr* to, socklen_t length) {
  if (carrier == nullptr || !is_simulated() || !this_program().is_member || !is_datagram_socket(descriptor))
    return false;
  const ErrorNumberKept kept;
  Address address{{}, sizeof address.bytes};
  if (to != nullptr && length <= sizeof address.bytes) {
    std::memcpy(&address.bytes, to, length);
    address.length = length;
  } else if (to != nullptr ||
             getpeername(descriptor, reinterpret_cast<sockaddr*>(&address.bytes), &address.length) != 0) {
    return false;
  }
  const Program* const receiver = receiver_of(address);
  if (receiver == nullptr) return false;
  auto* const memory = static_cast<Datagram*>(std::malloc(sizeof(Datagram) + size));
  const int copy = WAITPOINT_NEXT(fcntl)(descriptor, F_DUPFD_CLOEXEC, 0);
  if (memory == nullptr || copy < 0) {
    std::free(memory);
    return false;
  }
  auto* const datagram = new (memory) Datagram{copy, address, size};
  std::memcpy(datagram->bytes(), bytes, size);
  pass(kernel::Operation::send, nullptr);
  if (carrier->carry(carrier->network, *this_program().robot, *receiver->robot, size, arrive, drop, datagram))
    return true;
  drop(datagram);
  return false;
}

}  // namespace waitpoint::posix
