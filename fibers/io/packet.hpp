// SPDX-License-Identifier: BSD-3-Clause
// A message of sockets and mailboxes, between robots or within one: a value without pointers, which can be carried to
// another process. A kind decides what its parts mean, and which handler of the receiving node takes it
// (packet_handlers.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace waitpoint::io {

enum class PacketKind : std::uint8_t {
  datagram,     ///< to a port; from the sender's port, empty if it is not bound
  connect,      ///< to a listener's port, from the client's end; `number`: room in its buffer
  connected,    ///< to the client's end, from the server's; `number`: room in its buffer
  refused,      ///< to the client's end
  data,         ///< to an end of a stream; `number`: the room charged
  room,         ///< to an end; `number`: the room that was freed
  end_of_data,  ///< to an end: the peer has shut down its writing
  peer_gone,    ///< to an end: the peer is closed
  letter,       ///< to a mailbox's port, from a mailbox sender; `number`: the letter's type, see letter_type()
  receipt,      ///< to a mailbox sender; `number`: a Status
  parcel,       ///< `number`: of an object in the Parcels of the network; cannot leave the process
};

/// Where a packet comes from or goes to, on a robot: a bound name, or the number of a socket or mailbox sender. Numbers
/// are counted from 1 on each robot.
struct PacketEnd {
  std::string port = {};
  std::uint64_t socket = 0;
  friend bool operator==(const PacketEnd&, const PacketEnd&) = default;
};

/// The two robots are those of the link that carries it.
struct Packet {
  PacketKind kind = PacketKind::datagram;
  PacketEnd from = {};
  PacketEnd to = {};
  std::uint64_t number = 0;
  std::vector<std::byte> bytes = {};
  friend bool operator==(const Packet&, const Packet&) = default;
};

/// The packet for another process, and from one: the inverse of each other. A parcel, and bytes that are no packet, are
/// bugs.
std::vector<std::byte> to_bytes(const Packet& packet);
Packet packet_of(std::span<const std::byte> bytes);

}  // namespace waitpoint::io
