// SPDX-License-Identifier: BSD-3-Clause
// The addresses of internet sockets.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

namespace waitpoint::posix {

union InternetAddress {
  sockaddr any;
  sockaddr_in internet;
  sockaddr_in6 internet_6;
  sockaddr_storage room;
};

/// 0 without one.
inline in_port_t port_of(const InternetAddress& address) {
  const sa_family_t of = address.any.sa_family;
  return of == AF_INET ? ntohs(address.internet.sin_port) : of == AF_INET6 ? ntohs(address.internet_6.sin6_port) : 0;
}

/// False without one.
inline bool read_own_address(int descriptor, InternetAddress& address) {
  socklen_t size = sizeof address;
  return getsockname(descriptor, &address.any, &size) == 0;
}
inline bool read_peer_address(int descriptor, InternetAddress& address) {
  socklen_t size = sizeof address;
  return getpeername(descriptor, &address.any, &size) == 0;
}

}  // namespace waitpoint::posix
