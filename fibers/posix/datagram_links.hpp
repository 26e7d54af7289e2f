// SPDX-License-Identifier: BSD-3-Clause
// Datagrams between programs of different robots: what one sends to a socket of the other goes over the link between
// the two robots, and arrives when the link says so, or never. Streams arrive at once.
#pragma once

#include <sys/socket.h>

#include <cstddef>

#include "fibers/posix/guests.hpp"

namespace waitpoint::posix {

/// Of the run's; null for none.
void set_carrier(const Carrier* carrier);
/// Whether a datagram that the running thread sends is on its way over a link: to the address, or with null to where
/// the socket is connected to. Else it is to be sent as any.
bool send_over_link(int descriptor, const void* bytes, std::size_t size, const sockaddr* to, socklen_t length);

}  // namespace waitpoint::posix
