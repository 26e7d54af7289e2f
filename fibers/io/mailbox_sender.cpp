// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/mailbox_sender.hpp"

namespace waitpoint::io {

SenderCore::SenderCore(Network& network, const Address& address, std::size_t window)
    : Channel("mailbox sender", "to " + to_string(address)),
      network_(network),
      node_(network.own_node()),
      address_(address),
      link_(node_->link_to(address.robot)),
      room_(window) {
  WAITPOINT_REQUIRE(window > 0 && window <= letters_max,
                    "a mailbox sender's window holds at least one letter and at most 65536");
  node_->take_socket();
}

Status SenderCore::begin_letter(const Deadline& deadline) {
  if (!begin(kernel::Operation::send, sending_)) return Status::closed;
  if (link_ == nullptr) return Status::no_route;
  const Status status = wait(sending_, deadline, [&] { return room_ > 0 || status_ != Status::ok; });
  return status != Status::ok ? status : status_;
}

void SenderCore::send(std::size_t bytes, std::uint64_t hash, std::function<void(Channel&, Receipt)> arrive) {
  --room_;
  record_sent(to_string(address_), hash);
  Node& target = *network_.node(link_->to());
  link_->send_in_order(bytes, [&target, port = address_.port, own = node_->name(), sender = weak_from_this(),
                               arrive = std::move(arrive)] {
    // The receipt returns over the reverse link.
    const Receipt receipt = [&target, own, sender](Status status) {
      target.link_to(own)->send_in_order(0, [sender, status] {
        if (const auto there = sender.lock()) there->receipt(status);
      });
    };
    Channel* const channel = target.find(Protocol::mailbox, port);
    if (channel != nullptr)
      arrive(*channel, receipt);
    else
      receipt(Status::refused);
  });
}

void SenderCore::receipt(Status status) {
  if (status == Status::ok)
    ++room_;
  else if (status_ == Status::ok)
    status_ = status;
  wake_all(sending_);
}

Events SenderCore::ready() const {
  return when(room_ > 0 || status_ != Status::ok, Events::writable) | when(status_ != Status::ok, Events::closed);
}

}  // namespace waitpoint::io
