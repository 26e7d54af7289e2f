// SPDX-License-Identifier: BSD-3-Clause
// A mailbox of any type of letters, as a mailbox sender's packets find it.
#pragma once

#include "fibers/io/network.hpp"

namespace waitpoint::io {

/// Where to report what became of a mailbox sender's letter; nowhere for the own robot's letters.
struct Receipt {
  Link* link = nullptr;  // to the sender's robot
  std::uint64_t sender = 0;

  /// ok once the letter is received; refused or peer_closed if it never will be.
  void send(Status status) const {
    if (link == nullptr) return;
    link->send_in_order(
        0, {.kind = PacketKind::receipt, .to = {.socket = sender}, .number = static_cast<std::uint64_t>(status)});
  }
};

class LetterBox : public Channel {
 public:
  /// A letter from a mailbox sender: its letter_type() and its encoding. One of another type is a misuse.
  virtual void arrive(std::uint64_t type, std::span<const std::byte> letter, const Receipt& receipt) = 0;

 protected:
  using Channel::Channel;
};

}  // namespace waitpoint::io
