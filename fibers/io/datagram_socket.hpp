// SPDX-License-Identifier: BSD-3-Clause
// A datagram socket, to the semantics of UDP: messages with boundaries, to a name, that may be lost, may overtake each
// other where the medium's latency varies, and are dropped and counted where the receiver's queue is full.
//
//   io::datagram_socket socket(network);
//   socket.bind("position");
//   socket.send_to("bob:position", bytes);
#pragma once

#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "fibers/io/network.hpp"

namespace waitpoint::io {

inline constexpr std::size_t datagrams_max = 65536;
/// As UDP over IPv4 has it.
inline constexpr std::size_t datagram_bytes_max = 65507;

struct DatagramOptions {
  std::size_t queue_max = 64;                          ///< datagrams that wait to be received, up to datagrams_max
  std::size_t message_bytes_max = datagram_bytes_max;  ///< of one datagram
};

/// A datagram received.
struct Datagram {
  std::size_t size = 0;    ///< bytes copied to the buffer
  bool truncated = false;  ///< there were more, which are gone
  Address from;            ///< its port is empty if the sender was bound to none
};

/// What a socket's handle shares with a task that waits in it.
class DatagramCore : public Channel {
 public:
  DatagramCore(Network& network, const DatagramOptions& options);
  ~DatagramCore() override;
  Status bind(const std::string& port);
  Status send_to(const Address& address, std::span<const std::byte> data);
  Result<Datagram> receive(std::span<std::byte> buffer, const Deadline& deadline);
  void close();
  std::uint64_t dropped() const { return dropped_; }
  Events ready() const override;

 private:
  struct Message {
    std::vector<std::byte> bytes;
    Address from;
  };
  void arrive(Message message);

  Network& network_;
  std::shared_ptr<Node> node_;
  DatagramOptions options_;
  std::string port_;
  std::deque<Message> queue_;
  std::uint64_t dropped_ = 0;
  bool closed_ = false;
};

/// Movable; closed when it is destroyed. Any other use after close() is a bug.
class datagram_socket {
 public:
  datagram_socket() = default;  ///< closed
  /// Of the running task's robot.
  explicit datagram_socket(Network& network, const DatagramOptions& options = {})
      : core_(std::make_shared<DatagramCore>(network, options)) {}
  datagram_socket(datagram_socket&&) noexcept = default;
  datagram_socket& operator=(datagram_socket&& other) noexcept;
  ~datagram_socket();

  /// Takes a name on this robot: ok or address_in_use. A second name for one socket is a bug.
  Status bind(const std::string& port) { return use()->bind(port); }
  /// Does not wait. ok says that it was sent, not that it arrives; else message_too_long or no_route.
  Status send_to(const Address& address, std::span<const std::byte> data) { return use()->send_to(address, data); }
  /// The oldest datagram, cut to the buffer's size; closed if the socket is closed meanwhile.
  Result<Datagram> receive(std::span<std::byte> buffer, const Deadline& deadline = {}) {
    return use()->receive(buffer, deadline);
  }
  void close();

  bool is_open() const { return core_ != nullptr; }
  /// How many datagrams found the queue full.
  std::uint64_t dropped() const { return use()->dropped(); }
  std::shared_ptr<Channel> channel() const { return use(); }

 private:
  std::shared_ptr<DatagramCore> use() const {
    WAITPOINT_CHECK(core_ != nullptr, "a datagram socket is used after its close");
    return core_;
  }
  std::shared_ptr<DatagramCore> core_;
};

}  // namespace waitpoint::io
