// SPDX-License-Identifier: BSD-3-Clause
// A stream socket: bytes in order in both directions between two tasks, of one robot or of two, with the semantics of
// TCP.
//
//   robot bob                                             robot ada
//   io::stream_listener door(network);                    auto socket = io::connect(network, "bob:door", 2s);
//   door.listen("door");                                  if (socket) socket->write(question);
//   auto socket = door.accept();
//
// Nothing is lost: the medium delays. Flow control is by credit: bytes in transit or unread are limited to the
// receiver's buffer, and freed room is reported back over the medium. Between robots a short write is charged
// `least_charge`, which bounds the number of messages in transit, too.
//
//   write() -> credit_ falls --- bytes ---> received_ -> read()
//              credit_ rises <--- room --------------------'
#pragma once

#include <deque>
#include <memory>
#include <span>

#include "fibers/io/byte_queue.hpp"
#include "fibers/io/network.hpp"
#include "fibers/io/pipe.hpp"

namespace waitpoint::io {

/// The greatest message: longer writes are split.
inline constexpr std::size_t segment_bytes_max = 4096;
/// The least charge of a message between robots to the receiver's buffer, in bytes.
inline constexpr std::size_t least_charge = 64;

struct StreamOptions {
  std::size_t buffer_bytes = buffer_default;  ///< capacity for unread data; 1 to buffer_max
};

/// One end of a connection.
class Stream : public Channel {
 public:
  Stream(std::shared_ptr<Node> node, Link& link, const StreamOptions& options, const std::string& label);
  ~Stream() override;

  /// The client's side of the handshake: requests the connection and waits for the answer.
  Status connect(const std::string& port, const Deadline& deadline);
  /// The server's side: the connection that `client`, with `credit` bytes of room, requested.
  void answer(std::uint64_t client, std::size_t credit);

  Result<std::size_t> read(std::span<std::byte> buffer, const Deadline& deadline);
  Result<std::size_t> write(std::span<const std::byte> data, const Deadline& deadline);
  void shutdown_write();
  void close();
  const std::string& peer_robot() const { return link_.to(); }
  Events ready() const override;

  // Handlers of packets; this end may be closed already.
  static void take_answer(Node& node, Link& link, Packet& packet);
  void take_refusal(Packet& packet);
  void take_data(Packet& packet);
  void take_room(Packet& packet);
  void take_end_of_data(Packet& packet);
  void take_end_of_peer(Packet& packet);

 private:
  enum class State : std::uint8_t { asking, open, refused };

  void establish(std::uint64_t peer, std::size_t credit);
  void tell_peer(PacketKind kind, std::uint64_t number = 0, std::span<const std::byte> bytes = {});

  std::shared_ptr<Node> node_;
  Link& link_;              // to the peer's robot
  std::uint64_t number_;    // of this end on its robot
  std::uint64_t peer_ = 0;  // of the other end on its own
  State state_ = State::asking;
  ByteQueue received_;
  std::size_t extra_charge_ = 0;  // room charged for short messages beyond their bytes
  std::size_t credit_ = 0;        // bytes that may still be sent
  bool finished_ = false;         // shutdown_write() was called
  bool closed_ = false;
  bool peer_finished_ = false;
  bool peer_gone_ = false;
};

/// Movable; closed by its destructor. Any other use after close() is a misuse.
class stream_socket {
 public:
  stream_socket() = default;  ///< closed
  explicit stream_socket(std::shared_ptr<Stream> stream) : stream_(std::move(stream)) {}
  stream_socket(stream_socket&&) noexcept = default;
  stream_socket& operator=(stream_socket&& other) noexcept;
  ~stream_socket();

  /// Reads at least one byte and at most buffer.size(), and returns the number. end_of_file once all is read and the
  /// peer has closed or shut down its writing; closed if this end is closed meanwhile.
  Result<std::size_t> read(std::span<std::byte> buffer, const Deadline& deadline = {}) {
    return use()->read(buffer, deadline);
  }
  /// Sends all of `data` and returns the number of bytes, which is less only if the status is not ok. ok means sent,
  /// not read. peer_closed once the peer is known to have closed.
  Result<std::size_t> write(std::span<const std::byte> data, const Deadline& deadline = {}) {
    return use()->write(data, deadline);
  }
  /// Half-close: the peer reads end of file after the data written; reading remains possible. A write afterwards is a
  /// bug.
  void shutdown_write() { use()->shutdown_write(); }
  void close();

  bool is_open() const { return stream_ != nullptr; }
  /// The robot at the other end.
  std::string peer_robot() const { return use()->peer_robot(); }
  std::shared_ptr<Channel> channel() const { return use(); }

 private:
  std::shared_ptr<Stream> use() const {
    WAITPOINT_REQUIRE(stream_ != nullptr, "a stream socket is used after its close");
    return stream_;
  }
  std::shared_ptr<Stream> stream_;
};

/// Connects to a listener: refused if there is none or its backlog is full, no_route, timed_out, would_block (with
/// no_wait, between robots). The request and the answer each take the medium's time.
Result<stream_socket> connect(Network& network, const Address& address, const Deadline& deadline = {},
                              const StreamOptions& options = {});

}  // namespace waitpoint::io
