// SPDX-License-Identifier: BSD-3-Clause
// A connection between two processes of a viewed run: messages of any size, each with a descriptor if need be.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace waitpoint::tools::view {

/// A descriptor that is closed with its owner.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();

  int number() const { return number_; }
  int release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

class Channel {
 public:
  struct Message {
    std::string text;
    Descriptor descriptor;  ///< that came with it; -1: none
  };

  /// The two ends of a new connection. Throws std::system_error.
  static std::pair<Channel, Channel> make();

  /// Takes over a connected socket.
  explicit Channel(Descriptor socket) : socket_(std::move(socket)) {}

  int number() const { return socket_.number(); }
  /// False once the other end is gone.
  bool is_open() const { return is_open_; }

  /// Sends all of it, waiting for room; false if the other end is gone.
  bool send(std::string_view text, int descriptor = -1);
  /// Waits for the next message; nothing when the other end is gone.
  std::optional<Message> receive();

  // Without waiting, for one process that has many channels.

  /// Sends it now or by later calls of flush().
  void queue(std::string_view text);
  /// Sends as much as there is room for; true if nothing remains.
  bool flush();
  /// Bytes that are queued.
  std::size_t queued() const { return queued_; }
  /// The next message that has come whole.
  std::optional<Message> poll();
  /// False if the other end is gone, as far as can be seen without receiving.
  bool is_wanted() const;
  /// Waits up to `timeout_ms` for something to receive, or the end of the connection.
  bool has_news(int timeout_ms) const;

 private:
  bool read_more(bool waits);
  std::optional<Message> next();

  Descriptor socket_;
  bool is_open_ = true;
  std::string received_;
  std::deque<Descriptor> descriptors_;  // that have come with messages not yet handed over
  std::deque<std::string> outgoing_;
  std::size_t sent_of_first_ = 0, queued_ = 0;
};

}  // namespace waitpoint::tools::view
