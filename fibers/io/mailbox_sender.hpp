// SPDX-License-Identifier: BSD-3-Clause
// Sends to a mailbox by its name, on another robot or on this one. See mailbox.hpp.
#pragma once

#include <memory>
#include <utility>

#include "fibers/io/mailbox.hpp"

namespace waitpoint::io {

/// Shared by a sender's handle and its letters in transit.
class SenderCore : public Channel, public std::enable_shared_from_this<SenderCore> {
 public:
  SenderCore(Network& network, const Address& address, std::size_t window);
  ~SenderCore() override { node_->release_socket(); }

  /// Waits for room in the window.
  Status begin_letter(const Deadline& deadline);
  void send(std::size_t bytes, std::uint64_t hash, std::function<void(Channel&, Receipt)> arrive);
  Events ready() const override;

 private:
  void receipt(Status status);

  Network& network_;
  std::shared_ptr<Node> node_;
  Address address_;
  Link* link_;
  std::size_t room_;
  Status status_ = Status::ok;  // the mailbox's answer to letters that will never be received
};

/// Copies share their window. A letter of a type other than the mailbox's is a misuse.
template <Sendable T>
class mailbox_sender {
 public:
  /// A sender of the running task's robot. At most `window` letters, from one to letters_max, are in transit or not yet
  /// received.
  mailbox_sender(Network& network, const Address& address, std::size_t window = 16)
      : core_(std::make_shared<SenderCore>(network, address, window)) {}

  /// ok means that the letter was sent. refused once the medium has reported that the name is not bound (any more),
  /// peer_closed that the mailbox was closed with a letter in it; no_route.
  Status send(const T& letter, const Deadline& deadline = {}) {
    const std::shared_ptr<SenderCore> core = core_;
    const Status status = core->begin_letter(deadline);
    if (status != Status::ok) return status;
    core->send(wire_bytes(letter), hash_of(letter), [letter](Channel& channel, Receipt receipt) {
      auto* const box = dynamic_cast<mailbox<T>*>(&channel);
      WAITPOINT_REQUIRE(box != nullptr, "a letter is sent to a mailbox of another type");
      box->arrive(letter, std::move(receipt));
    });
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
};

}  // namespace waitpoint::io
