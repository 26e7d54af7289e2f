// SPDX-License-Identifier: BSD-3-Clause
// Partners of the program outside of the simulation: native processes, on this machine or others, at the far end of its
// sockets. They live in real time.
#pragma once

#include <netinet/in.h>

#include <cstdint>

namespace waitpoint::posix {

enum class Partner : std::uint8_t {
  none,      ///< both ends are of the family
  input,     ///< no process at a socket: a terminal, standard input
  possible,  ///< a socket that listens, or is not connected; or a named pipe: the other end may be inside, too
  certain,   ///< it is connected with a process that is not of the family
};

/// What is at the far end of a descriptor outside; with epoll, of any that it watches.
Partner partner_at(int descriptor);

/// True if a descriptor is open at which a certain partner was found.
bool has_partner();

/// An internet socket of the family is bound.
void note_bound(int descriptor);
/// An internet socket of the family listens, or is about to be connected. Both before the other end can wait for it.
void note_listening(int descriptor);
void note_connecting(int descriptor);
/// The connection was made: it waits to be accepted, if the other end is the family's. Or one was accepted.
void note_connected(int descriptor);
void note_accepted(int listening);
/// Waits in real time until the system shows a connection that waits to be accepted there, if one does: on a loaded
/// machine the last step of a connection can be late.
void await_connection(int listening);
/// The number of the connection between two ports, in the order in which the family made them, by the one that it was
/// made from; 0 if it did not make it from there.
std::uint32_t connection_from(in_port_t port);
/// Called, unless null, for a port of the family.
extern void (*after_own_port)(std::uint16_t port);
/// `epoll` watches the descriptor outside from now on.
void note_watched(int epoll, int descriptor);
/// The descriptor is closed.
void forget_watched(int descriptor);

}  // namespace waitpoint::posix
