// SPDX-License-Identifier: BSD-3-Clause
// A datagram socket, with the semantics of UDP: messages with boundaries, sent to a name. They may be lost, may arrive
// out of order if the medium's latency varies, and are dropped and counted if the receiver's queue is full.
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
/// The limit of UDP over IPv4.
inline constexpr std::size_t datagram_bytes_max = 65507;

struct DatagramOptions {
  std::size_t queue_max = 64;                          ///< capacity of the receive queue in datagrams, up to
                                                       ///< datagrams_max
  std::size_t message_bytes_max = datagram_bytes_max;  ///< of one datagram
};

/// A received datagram.
struct Datagram {
  std::size_t size = 0;    ///< bytes copied to the buffer
  bool truncated = false;  ///< the rest was discarded
  Address from;            ///< its port is empty if the sender was not bound
};

/// Shared by a socket's handle and the tasks that wait in it.
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
  /// The handler of datagrams.
  static void take_datagram(Node& node, Link& link, Packet& packet);

 private:
  struct Message {
    std::vector<std::byte> bytes;
    Address from;
  };
  void arrive(Message message);

  std::shared_ptr<Node> node_;
  DatagramOptions options_;
  std::uint64_t number_;
  std::string port_;
  std::deque<Message> queue_;
  std::uint64_t dropped_ = 0;
  bool closed_ = false;
};

/// Movable; closed by its destructor. Any other use after close() is a misuse.
class datagram_socket {
 public:
  datagram_socket() = default;  ///< closed
  /// A socket of the running task's robot.
  explicit datagram_socket(Network& network, const DatagramOptions& options = {})
      : core_(std::make_shared<DatagramCore>(network, options)) {}
  datagram_socket(datagram_socket&&) noexcept = default;
  datagram_socket& operator=(datagram_socket&& other) noexcept;
  ~datagram_socket();

  /// Binds a name on this robot: ok or address_in_use. A second name for one socket is a misuse.
  Status bind(const std::string& port) { return use()->bind(port); }
  /// Does not wait. ok means sent, not delivered; else message_too_long or no_route.
  Status send_to(const Address& address, std::span<const std::byte> data) { return use()->send_to(address, data); }
  /// The oldest datagram, truncated to the buffer's size; closed if the socket is closed meanwhile.
  Result<Datagram> receive(std::span<std::byte> buffer, const Deadline& deadline = {}) {
    return use()->receive(buffer, deadline);
  }
  void close();

  bool is_open() const { return core_ != nullptr; }
  /// The number of datagrams dropped at the full queue.
  std::uint64_t dropped() const { return use()->dropped(); }
  std::shared_ptr<Channel> channel() const { return use(); }

 private:
  std::shared_ptr<DatagramCore> use() const {
    WAITPOINT_REQUIRE(core_ != nullptr, "a datagram socket is used after its close");
    return core_;
  }
  std::shared_ptr<DatagramCore> core_;
};

}  // namespace waitpoint::io
