// SPDX-License-Identifier: BSD-3-Clause
// Datagrams between programs of different robots: they go over the link between the two robots, which decides when they
// arrive, or that they are lost.
#pragma once

#include <sys/socket.h>

#include <cstddef>

namespace waitpoint::posix {

/// Sends a datagram over a link: to the address, or with null to the socket's peer. False if none leads there: then the
/// system sends it.
bool send_over_link(int descriptor, const void* bytes, std::size_t size, const sockaddr* to, socklen_t length);
/// The same for a datagram in parts, without ancillary data; sets `size` to the sum of the parts.
bool send_over_link(int descriptor, const msghdr& message, std::size_t& size);

}  // namespace waitpoint::posix
