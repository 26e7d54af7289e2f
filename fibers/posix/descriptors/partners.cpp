// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/descriptors/partners.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <utility>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/inside_files.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/family/system_processes.hpp"

namespace waitpoint::posix {
namespace {

/// What an epoll descriptor watches outside.
struct Watched {
  bool is_any = false;
  Partner nearest = Partner::none;
};
Watched watched_by[known_descriptors_max];  // by epoll descriptors
bool is_certain[known_descriptors_max];     // a certain partner was found there
int certain_count = 0;

/// The ports of the family's internet sockets, a bit each.
struct Ports {
  std::uint64_t words[65536 / 64];
};

Ports* ports() { return static_cast<Ports*>(family::common(family::Part::ports, sizeof(Ports))); }

union Address {
  sockaddr any;
  sockaddr_in internet;
  sockaddr_in6 internet_6;
  sockaddr_storage room;
};

// 0 without one.
in_port_t port_of(const Address& address) {
  const sa_family_t of = address.any.sa_family;
  return of == AF_INET ? ntohs(address.internet.sin_port) : of == AF_INET6 ? ntohs(address.internet_6.sin6_port) : 0;
}

// Over the loopback, or by the machine's own address: then both ends have it.
bool is_of_this_machine(int descriptor, const Address& peer) {
  Address own{};
  socklen_t size = sizeof own;
  const bool is_known = getsockname(descriptor, &own.any, &size) == 0;
  if (peer.any.sa_family == AF_INET) {
    const in_addr_t host = peer.internet.sin_addr.s_addr;
    return ntohl(host) >> 24 == 127 || (is_known && host == own.internet.sin_addr.s_addr);
  }
  const in6_addr& host = peer.internet_6.sin6_addr;
  return IN6_IS_ADDR_LOOPBACK(&host) || (IN6_IS_ADDR_V4MAPPED(&host) && host.s6_addr[12] == 127) ||
         (is_known && IN6_ARE_ADDR_EQUAL(&host, &own.internet_6.sin6_addr));
}

Partner peer_of_local(int descriptor) {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (WAITPOINT_NEXT(getsockopt)(descriptor, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0 || peer.pid <= 0)
    return Partner::possible;
  const bool is_outside = family::find_in_system(peer.pid) == nullptr && family::is_running(peer.pid);
  return is_outside ? Partner::certain : Partner::none;
}

Partner partner_of_socket(int descriptor) {
  Address peer{};
  socklen_t size = sizeof peer;
  if (getpeername(descriptor, &peer.any, &size) != 0) return Partner::possible;
  if (peer.any.sa_family == AF_UNIX) return peer_of_local(descriptor);
  const in_port_t port = port_of(peer);
  const Ports* const own = ports();
  if (port == 0 || own == nullptr) return Partner::possible;
  if (!is_of_this_machine(descriptor, peer)) return Partner::certain;
  return (own->words[port / 64] >> (port % 64) & 1) != 0 ? Partner::none : Partner::certain;
}

Partner noted(int descriptor, Partner partner) {
  if (partner == Partner::certain && !is_certain[descriptor]) {
    is_certain[descriptor] = true;
    ++certain_count;
  }
  return partner;
}

bool is_known(int descriptor) { return descriptor >= 0 && descriptor < known_descriptors_max; }

}  // namespace

Partner partner_at(int descriptor) {
  if (!is_known(descriptor) || is_inside(descriptor)) return Partner::none;
  if (watched_by[descriptor].is_any) return watched_by[descriptor].nearest;
  const ErrorNumberKept kept;
  struct stat of {};
  if (fstat(descriptor, &of) != 0) return Partner::none;
  if (S_ISSOCK(of.st_mode)) return noted(descriptor, partner_of_socket(descriptor));
  return S_ISFIFO(of.st_mode) && descriptor > STDERR_FILENO ? Partner::possible : Partner::input;
}

bool has_partner() { return certain_count > 0; }

void note_own_port(int descriptor) {
  const ErrorNumberKept kept;
  Address own{};
  socklen_t size = sizeof own;
  if (getsockname(descriptor, &own.any, &size) != 0) return;
  const in_port_t port = port_of(own);
  if (Ports* const all = ports(); all != nullptr && port != 0) all->words[port / 64] |= std::uint64_t{1} << (port % 64);
}

void note_watched(int epoll, int descriptor) {
  if (is_known(epoll)) watched_by[epoll] = {true, std::max(watched_by[epoll].nearest, partner_at(descriptor))};
}

void forget_watched(int descriptor) {
  if (!is_known(descriptor)) return;
  watched_by[descriptor] = {};
  if (std::exchange(is_certain[descriptor], false)) --certain_count;
}

}  // namespace waitpoint::posix
