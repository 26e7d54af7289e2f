// SPDX-License-Identifier: BSD-3-Clause
// Datagrams between programs of different robots: what one sends to a socket of the other goes over the link between
// the two robots, and arrives when the link says so, or never.
#pragma once

#include <sys/socket.h>

#include <cstddef>

namespace waitpoint::posix {

/// Whether a datagram that the running thread sends is on its way over a link: to the address, or with null to where
/// the socket is connected to. Else it is to be sent as any.
bool send_over_link(int descriptor, const void* bytes, std::size_t size, const sockaddr* to, socklen_t length);
/// The same of one in parts, which takes nothing along beside its bytes; `size` is that of all.
bool send_over_link(int descriptor, const msghdr& message, std::size_t& size);

}  // namespace waitpoint::posix
