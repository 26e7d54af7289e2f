// SPDX-License-Identifier: BSD-3-Clause
// The handshake of a stream's ends: the client's request, by way of the listener, and the server's answer.
#include "fibers/io/stream_listener.hpp"
#include "fibers/io/stream_socket.hpp"

namespace waitpoint::io {

Status Stream::connect(Node& target, const std::string& port, const Deadline& deadline) {
  if (!begin(kernel::Operation::connect, sending_)) return Status::closed;
  link_.send_in_order(0, [&target, port, client = weak_from_this(), own = node_->name(), credit = received_.capacity(),
                          &question = link_] {
    auto* const listener = static_cast<Listener*>(target.find(Protocol::stream, port));
    Link& back = *target.link_to(own);
    const std::shared_ptr<Stream> server = listener != nullptr ? listener->accept_request(back) : nullptr;
    if (server != nullptr) {
      server->answer(client, credit, question);
    } else {
      back.send_in_order(0, [client] {
        if (const auto there = client.lock()) there->refuse();
      });
    }
  });
  const Status status = wait(sending_, deadline, [&] { return state_ != State::asking || closed_; });
  if (status != Status::ok) return status;
  return closed_ ? Status::closed : state_ == State::refused ? Status::refused : Status::ok;
}

void Stream::answer(const std::weak_ptr<Stream>& client, std::size_t credit, Link& question) {
  established(client, credit);
  link_.send_in_order(0, [client, server = weak_from_this(), own_room = received_.capacity(), &question] {
    if (const std::shared_ptr<Stream> there = client.lock()) {
      there->established(server, own_room);
      return;
    }
    // The client has given up meanwhile; the server must be told.
    question.send_in_order(0, [server] {
      if (const std::shared_ptr<Stream> left = server.lock()) left->peer_gone();
    });
  });
}

}  // namespace waitpoint::io
