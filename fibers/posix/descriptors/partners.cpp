// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/descriptors/partners.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <utility>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/real_waits.hpp"
#include "fibers/posix/descriptors/inside_files.hpp"
#include "fibers/posix/descriptors/internet_address.hpp"
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

/// The ports of the family's internet sockets, a bit each, and the numbers of the connections made from them.
struct Ports {
  std::uint64_t words[65536 / 64];
  std::uint32_t connections[65536];
  std::int32_t not_accepted[65536];  ///< connections, by the port that listens
  std::uint32_t last_connection;
};

Ports* ports() { return static_cast<Ports*>(family::common(family::Part::ports, sizeof(Ports))); }

// Over the loopback, or by the machine's own address: then both ends have it.
bool is_of_this_machine(int descriptor, const InternetAddress& peer) {
  InternetAddress own{};
  const bool is_known = read_own_address(descriptor, own);
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
  InternetAddress peer{};
  if (!read_peer_address(descriptor, peer)) return Partner::possible;
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
  if (WAITPOINT_NEXT(fstat)(descriptor, &of) != 0) return Partner::none;
  if (S_ISSOCK(of.st_mode)) return noted(descriptor, partner_of_socket(descriptor));
  return S_ISFIFO(of.st_mode) && descriptor > STDERR_FILENO ? Partner::possible : Partner::input;
}

bool has_partner() { return certain_count > 0; }

void (*after_own_port)(std::uint16_t port) = nullptr;

namespace {

// 0 if the socket has none.
in_port_t note_own_port(int descriptor, Ports& all) {
  const ErrorNumberKept kept;
  InternetAddress own{};
  if (!read_own_address(descriptor, own)) return 0;
  const in_port_t port = port_of(own);
  if (port == 0) return 0;
  all.words[port / 64] |= std::uint64_t{1} << (port % 64);
  if (after_own_port != nullptr) after_own_port(port);
  return port;
}

}  // namespace

void note_bound(int descriptor) {
  if (Ports* const all = ports(); all != nullptr) note_own_port(descriptor, *all);
}

void note_listening(int descriptor) {
  Ports* const all = ports();
  if (all == nullptr) return;
  if (const in_port_t port = note_own_port(descriptor, *all); port != 0)
    all->connections[port] = 0, all->not_accepted[port] = 0;
}

void note_connecting(int descriptor) {
  Ports* const all = ports();
  if (all == nullptr) return;
  if (const in_port_t port = note_own_port(descriptor, *all); port != 0)
    all->connections[port] = ++all->last_connection;
}

void note_connected(int descriptor) {
  const ErrorNumberKept kept;
  InternetAddress peer{};
  Ports* const all = ports();
  if (all == nullptr || !read_peer_address(descriptor, peer)) return;
  const in_port_t port = port_of(peer);
  const bool is_of_family = (all->words[port / 64] >> (port % 64) & 1) != 0;
  if (port != 0 && is_of_family && is_of_this_machine(descriptor, peer)) ++all->not_accepted[port];
}

namespace {

std::int32_t* not_accepted_at(int listening) {
  InternetAddress own{};
  Ports* const all = ports();
  return all != nullptr && read_own_address(listening, own) ? &all->not_accepted[port_of(own)] : nullptr;
}

}  // namespace

void note_accepted(int listening) {
  const ErrorNumberKept kept;
  if (std::int32_t* const count = not_accepted_at(listening); count != nullptr && *count > 0) --*count;
}

void await_connection(int listening) {
  constexpr int patience_ms = 200;
  const ErrorNumberKept kept;
  std::int32_t* const count = not_accepted_at(listening);
  if (count == nullptr || *count <= 0) return;
  const RealWait real;
  pollfd one{listening, POLLIN, 0};
  if (WAITPOINT_NEXT(poll)(&one, 1, patience_ms) == 0) *count = 0;
}

std::uint32_t connection_from(in_port_t port) {
  const Ports* const all = ports();
  return all != nullptr ? all->connections[port] : 0;
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
