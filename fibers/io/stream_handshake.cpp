// SPDX-License-Identifier: BSD-3-Clause
// The handshake of a stream's ends: the client's request, by way of the listener, and the server's answer.
#include "fibers/io/stream_listener.hpp"
#include "fibers/io/stream_socket.hpp"

namespace waitpoint::io {

Status Stream::connect(const std::string& port, const Deadline& deadline) {
  if (!begin(kernel::Operation::connect, sending_)) return Status::closed;
  link_.send_in_order(
      0,
      {.kind = PacketKind::connect, .from = {.socket = number_}, .to = {.port = port}, .number = received_.capacity()});
  const Status status = wait(sending_, deadline, [&] { return state_ != State::asking || closed_; });
  if (status != Status::ok) return status;
  return closed_ ? Status::closed : state_ == State::refused ? Status::refused : Status::ok;
}

void Listener::take_request(Node& node, Link& link, Packet& packet) {
  auto* const listener = static_cast<Listener*>(node.find(Protocol::stream, packet.to.port));
  Link& back = *node.link_to(link.from());
  Stream* const server = listener != nullptr ? listener->accept_request(back) : nullptr;
  if (server != nullptr)
    server->answer(packet.from.socket, packet.number);
  else
    back.send_in_order(0, {.kind = PacketKind::refused, .to = packet.from});
}

void Stream::answer(std::uint64_t client, std::size_t credit) {
  establish(client, credit);
  link_.send_in_order(0, {.kind = PacketKind::connected,
                          .from = {.socket = number_},
                          .to = {.socket = client},
                          .number = received_.capacity()});
}

void Stream::take_answer(Node& node, Link& link, Packet& packet) {
  if (auto* const client = static_cast<Stream*>(node.socket(packet.to.socket)); client != nullptr)
    return client->establish(packet.from.socket, packet.number);
  // The client has given up meanwhile; the server must be told.
  node.link_to(link.from())->send_in_order(0, {.kind = PacketKind::peer_gone, .to = packet.from});
}

}  // namespace waitpoint::io
