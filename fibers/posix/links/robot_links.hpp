// SPDX-License-Identifier: BSD-3-Clause
// Sockets of programs of different robots: the carrier, and the program at the other end.
#pragma once

#include <sys/socket.h>

#include "fibers/posix/links/carrier.hpp"

namespace waitpoint::posix {

/// Sets the run's carrier. Before null, at the run's end, forget_streams() must be called (stream_links.hpp).
void set_carrier(const Carrier* carrier);
/// The carrier from the running thread's program to those of other robots; null without one.
const Carrier* carrier_here();

struct SocketAddress {
  sockaddr_storage bytes{};
  socklen_t length = sizeof bytes;
  sockaddr* get() { return reinterpret_cast<sockaddr*>(&bytes); }
};
/// False without an address. `address` must be new: its length is the capacity.
bool take_own_address(int descriptor, SocketAddress& address);
bool take_peers_address(int descriptor, SocketAddress& address);
/// True if a socket bound to `bound` is reached at `address`: INADDR_ANY matches every address.
bool is_at(const SocketAddress& bound, const SocketAddress& address);

/// SOCK_STREAM, SOCK_DGRAM etc.; -1 if the descriptor is no socket.
int type_of_socket(int descriptor);
/// The carrier's receiver with a socket of this type at this address; with `peer`, one that is connected to it or
/// listens. Null without one.
const void* receiver_at(const SocketAddress& address, int type, const SocketAddress* peer);

}  // namespace waitpoint::posix
