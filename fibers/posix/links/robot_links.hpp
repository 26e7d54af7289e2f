// SPDX-License-Identifier: BSD-3-Clause
// Sockets of programs of different robots: what carries between them, and whose is at the other end.
#pragma once

#include <sys/socket.h>

#include "fibers/posix/links/carrier.hpp"

namespace waitpoint::posix {

struct Program;

/// Of the run's; null for none: then streams are to be forgotten (stream_links.hpp).
void set_carrier(const Carrier* carrier);
/// By which the running thread's program reaches those of other robots; null if it is on its own.
const Carrier* carrier_here();

struct SocketAddress {
  sockaddr_storage bytes{};
  socklen_t length = sizeof bytes;
  sockaddr* get() { return reinterpret_cast<sockaddr*>(&bytes); }
};
/// False if it has none.
bool take_own_address(int descriptor, SocketAddress& address);
bool take_peers_address(int descriptor, SocketAddress& address);
/// What is bound to any address of the machine is met at each.
bool is_at(const SocketAddress& bound, const SocketAddress& address);

/// SOCK_STREAM, SOCK_DGRAM and so on; -1 of what is no socket.
int type_of_socket(int descriptor);
/// The program of another robot with a socket at this address, of this type; if `peer` is given, one that is connected
/// to that, or listens. Null without one.
const Program* program_at(const SocketAddress& address, int type, const SocketAddress* peer);

}  // namespace waitpoint::posix
