// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/links/robot_links.hpp"

#include <netinet/in.h>

#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/owners.hpp"
#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {
namespace {

const Carrier* carrier = nullptr;

int option_of(int descriptor, int option) {
  int value = 0;
  socklen_t size = sizeof value;
  const ErrorNumberKept kept;
  return WAITPOINT_NEXT(getsockopt)(descriptor, SOL_SOCKET, option, &value, &size) == 0 ? value : -1;
}

bool is_connected_to(int descriptor, const SocketAddress& peer) {
  SocketAddress other;
  return take_peers_address(descriptor, other) && is_at(other, peer);
}

}  // namespace

void set_carrier(const Carrier* to) { carrier = to; }

const Carrier* carrier_here() {
  const bool carries = carrier != nullptr && is_simulated() && (this_program().is_loaded || carrier->find != nullptr);
  return carries ? carrier : nullptr;
}

bool take_own_address(int descriptor, SocketAddress& address) {
  WAITPOINT_CHECK(address.length == sizeof address.bytes, "an address is read into one in use");
  const ErrorNumberKept kept;
  return getsockname(descriptor, address.get(), &address.length) == 0;
}

bool take_peers_address(int descriptor, SocketAddress& address) {
  WAITPOINT_CHECK(address.length == sizeof address.bytes, "an address is read into one in use");
  const ErrorNumberKept kept;
  return getpeername(descriptor, address.get(), &address.length) == 0;
}

static_assert(sizeof(sockaddr_in) <= sizeof(sockaddr_storage));
static_assert(alignof(sockaddr_in) <= alignof(sockaddr_storage));

bool is_at(const SocketAddress& bound, const SocketAddress& address) {
  WAITPOINT_CHECK(address.length <= sizeof address.bytes, "an address is longer than its memory");
  if (bound.bytes.ss_family != address.bytes.ss_family) return false;
  if (address.bytes.ss_family != AF_INET)
    return bound.length == address.length && std::memcmp(&bound.bytes, &address.bytes, address.length) == 0;
  const auto& here = reinterpret_cast<const sockaddr_in&>(bound.bytes);
  const auto& there = reinterpret_cast<const sockaddr_in&>(address.bytes);
  return here.sin_port == there.sin_port &&
         (here.sin_addr.s_addr == there.sin_addr.s_addr || here.sin_addr.s_addr == htonl(INADDR_ANY));
}

int type_of_socket(int descriptor) { return option_of(descriptor, SO_TYPE); }

const void* receiver_at(const SocketAddress& address, int type, const SocketAddress* peer) {
  WAITPOINT_CHECK(carrier != nullptr, "a receiver is looked for without a carrier");
  if (carrier->find != nullptr) return carrier->find(address, type);
  const Program* owner = nullptr;
  for (int at = next_owned(0, owner); at >= 0; at = next_owned(at + 1, owner)) {
    SocketAddress bound;
    if (owner->robot == this_program().robot || type_of_socket(at) != type) continue;
    if (!take_own_address(at, bound) || !is_at(bound, address)) continue;
    if (peer == nullptr || option_of(at, SO_ACCEPTCONN) == 1 || is_connected_to(at, *peer)) return owner->robot;
  }
  return nullptr;
}

}  // namespace waitpoint::posix
