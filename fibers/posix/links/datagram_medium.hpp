// SPDX-License-Identifier: BSD-3-Clause
// The medium of a run's datagrams between its processes (Settings::medium): each UDP datagram is lost with a
// probability, or arrives after a delay. Both are drawn from a stream of the sending process. A multicast datagram is
// lost, or arrives, for all of its receivers.
//
// Datagrams of one process arrive by their times, equal ones in the order of sending.
#pragma once

#include <sys/socket.h>

#include <cstddef>

namespace waitpoint::posix {

/// Sends a datagram through the medium; `size` becomes the sum of its parts. False if the system is to send it: there
/// is no medium, the descriptor is no UDP socket, or it is not lost and has no delay.
bool send_through_medium(int descriptor, const msghdr& message, std::size_t& size);
/// Before the process ends: what is under way arrives now.
void deliver_datagrams();
/// In a forked child: what is under way is the parent's.
void forget_datagrams();

}  // namespace waitpoint::posix
