// SPDX-License-Identifier: BSD-3-Clause
// Sends to a mailbox by its name, on another robot or on this one. See mailbox.hpp.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "fibers/io/mailbox.hpp"

namespace waitpoint::io {

/// Shared by the copies of a sender.
class SenderCore : public Channel {
 public:
  SenderCore(Network& network, const Address& address, std::size_t window);
  ~SenderCore() override { node_->remove_socket(number_); }

  /// Waits for room in the window.
  Status begin_letter(const Deadline& deadline);
  void send(std::uint64_t type, std::vector<std::byte> letter, std::uint64_t hash);
  Events ready() const override;
  // Handlers of packets: at the mailbox, and back at the sender.
  static void take_letter(Node& node, Link& link, Packet& packet);
  static void take_receipt(Node& node, Link& link, Packet& packet);

 private:
  std::shared_ptr<Node> node_;
  std::uint64_t number_;
  Address address_;
  Link* link_;
  std::size_t room_;
  Status status_ = Status::ok;  // the mailbox's answer to letters that will never be received
};

/// Copies share their window. Of a letter, its declared fields arrive. A letter whose fields have other names or types
/// than the mailbox's is a misuse.
template <Sendable T>
class mailbox_sender {
 public:
  /// A sender of the running task's robot. At most `window` letters, from one to letters_max, are in transit or not yet
  /// received.
  mailbox_sender(Network& network, const Address& address, std::size_t window = 16)
      : core_(std::make_shared<SenderCore>(network, address, window)), type_(letter_type<T>()) {}

  /// ok means that the letter was sent. refused once the medium has reported that the name is not bound (any more),
  /// peer_closed that the mailbox was closed with a letter in it; no_route.
  Status send(const T& letter, const Deadline& deadline = {}) {
    const std::shared_ptr<SenderCore> core = core_;
    const Status status = core->begin_letter(deadline);
    if (status != Status::ok) return status;
    const std::uint64_t hash = hash_of(letter);
    const sync::IgnoredAccesses ignored_accesses;
    core->send(type_, encoded(letter), hash);
    return Status::ok;
  }
  Status try_send(const T& letter) { return send(letter, no_wait); }
  template <class Span>
  Status send_for(const T& letter, const Span& span) {
    return send(letter, Deadline(span));
  }

  std::shared_ptr<Channel> channel() const { return core_; }

 private:
  std::shared_ptr<SenderCore> core_;
  std::uint64_t type_;
};

}  // namespace waitpoint::io
