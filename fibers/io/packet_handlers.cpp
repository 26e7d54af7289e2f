// SPDX-License-Identifier: BSD-3-Clause
// The table of handlers: what the node of the receiver does with a packet, by its kind.
#include <iterator>

#include "fibers/io/datagram_socket.hpp"
#include "fibers/io/mailbox_sender.hpp"
#include "fibers/io/stream_listener.hpp"
#include "fibers/io/stream_socket.hpp"

namespace waitpoint::io {
namespace {

/// A packet to `node` that came over `link`.
using Handler = void (*)(Node& node, Link& link, Packet& packet);

// To an end of a stream, if it still exists.
template <void (Stream::*act)(Packet&)>
void to_stream(Node& node, Link&, Packet& packet) {
  if (auto* const stream = static_cast<Stream*>(node.socket(packet.to.socket)); stream != nullptr)
    (stream->*act)(packet);
}

void take_parcel(Node& node, Link&, Packet& packet) { node.parcels().arrive(packet.number); }

constexpr Handler handlers[] = {
    DatagramCore::take_datagram,           // datagram
    Listener::take_request,                // connect
    Stream::take_answer,                   // connected
    to_stream<&Stream::take_refusal>,      // refused
    to_stream<&Stream::take_data>,         // data
    to_stream<&Stream::take_room>,         // room
    to_stream<&Stream::take_end_of_data>,  // end_of_data
    to_stream<&Stream::take_end_of_peer>,  // peer_gone
    SenderCore::take_letter,               // letter
    SenderCore::take_receipt,              // receipt
    take_parcel,                           // parcel
};
static_assert(std::size(handlers) == static_cast<std::size_t>(PacketKind::parcel) + 1);

}  // namespace

void Node::receive(Link& link, Packet& packet) { handlers[static_cast<std::size_t>(packet.kind)](*this, link, packet); }

}  // namespace waitpoint::io
