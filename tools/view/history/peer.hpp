// SPDX-License-Identifier: BSD-3-Clause
// A process that answers requests over a channel, one after the other, as its client without waiting sees it.
#pragma once

#include <deque>
#include <functional>
#include <string>

#include "tools/view/history/channel.hpp"

namespace waitpoint::tools::view {

class Peer {
 public:
  /// Null: the process has ended without a reply.
  using Reply = std::function<void(Channel::Message* reply)>;

  explicit Peer(Channel channel) : channel_(std::move(channel)) {}

  int number() const { return channel_.number(); }
  bool is_open() const { return channel_.is_open(); }
  bool is_idle() const { return replies_.empty(); }

  void ask(std::string_view request, Reply reply) {
    replies_.push_back(std::move(reply));
    channel_.queue(request);
  }

  /// Call when the channel has something to read: hands over replies. They may ask again, but not destroy the peer.
  void take_replies() {
    while (auto message = channel_.poll()) {
      const Reply reply = std::move(replies_.front());
      replies_.pop_front();
      reply(&*message);
    }
    while (!channel_.is_open() && !replies_.empty()) {
      const Reply reply = std::move(replies_.front());
      replies_.pop_front();
      reply(nullptr);
    }
  }

 private:
  Channel channel_;
  std::deque<Reply> replies_;
};

}  // namespace waitpoint::tools::view
