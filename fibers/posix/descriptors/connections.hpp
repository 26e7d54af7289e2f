// SPDX-License-Identifier: BSD-3-Clause
// Which descriptors an action concerns: the bits by which it finds the processes that wait for its other end, so that
// the others need not check (family/order.hpp).
//
// A connected internet socket belongs to two flows, one in each direction. Who sends changes the one that the peer
// awaits to read; who receives makes room in it, which the peer may await to write. Two flows or pipes with the same
// bit only cost checks in vain. What is not known awaits, and changes, all.
#pragma once

#include "fibers/posix/family/family.hpp"

namespace waitpoint::posix {

/// What a transfer in the direction of `events` (POLLIN, POLLOUT or both) by this descriptor may change, and likewise
/// what a thread awaits that waits for these events. Of an epoll descriptor: what any that it watches awaits.
family::Changes changes_at(int descriptor, short events);
/// True for a stream over the loopback whose two ends are the family's.
bool is_within_family(int descriptor);

/// Waits in real time for connections to the sockets that listen, as far as the family has made them.
void await_connections();

/// The descriptor is closed, or connects anew.
void forget_connection(int descriptor);

}  // namespace waitpoint::posix
