// SPDX-License-Identifier: BSD-3-Clause
// A name that stream sockets connect to, like a listening TCP socket: connections are established at the request, and
// wait in a bounded backlog until accepted.
#pragma once

#include <deque>
#include <memory>
#include <string>

#include "fibers/io/stream_socket.hpp"

namespace waitpoint::io {

struct ListenOptions {
  std::size_t backlog = 16;   ///< connections waiting to be accepted; more are refused
  StreamOptions stream = {};  ///< of the connections
};

/// Shared by a listener's handle and the tasks that wait in it.
class Listener : public Channel {
 public:
  Listener(Network& network, const ListenOptions& options);
  ~Listener() override;
  Status listen(const std::string& port);
  Result<std::shared_ptr<Stream>> accept(const Deadline& deadline);
  void close();
  Events ready() const override;
  /// The handler of requests for connections.
  static void take_request(Node& node, Link& link, Packet& packet);

 private:
  // The server's end for a connection requested over the link with the reverse link `back`; null if it is refused.
  Stream* accept_request(Link& back);

  std::shared_ptr<Node> node_;
  ListenOptions options_;
  std::uint64_t number_;
  std::string port_;
  std::deque<std::shared_ptr<Stream>> backlog_;
  bool closed_ = false;
};

/// Movable; closed by its destructor, with the connections not yet accepted. Any other use after close() is a misuse.
class stream_listener {
 public:
  stream_listener() = default;  ///< closed
  /// A listener of the running task's robot.
  explicit stream_listener(Network& network, const ListenOptions& options = {})
      : core_(std::make_shared<Listener>(network, options)) {}
  stream_listener(stream_listener&&) noexcept = default;
  stream_listener& operator=(stream_listener&& other) noexcept;
  ~stream_listener();

  /// Binds a name on this robot: ok or address_in_use. A second name for one listener is a misuse.
  Status listen(const std::string& port) { return use()->listen(port); }
  /// The connection that has waited longest; closed if the listener is closed meanwhile.
  Result<stream_socket> accept(const Deadline& deadline = {});
  void close();

  bool is_open() const { return core_ != nullptr; }
  std::shared_ptr<Channel> channel() const { return use(); }

 private:
  std::shared_ptr<Listener> use() const {
    WAITPOINT_REQUIRE(core_ != nullptr, "a stream listener is used after its close");
    return core_;
  }
  std::shared_ptr<Listener> core_;
};

}  // namespace waitpoint::io
