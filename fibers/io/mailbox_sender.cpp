// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/mailbox_sender.hpp"

namespace waitpoint::io {

SenderCore::SenderCore(Network& network, const Address& address, std::size_t window)
    : Channel("mailbox sender", "to " + to_string(address)),
      node_(network.own_node()),
      address_(address),
      link_(node_->link_to(address.robot)),
      room_(window) {
  WAITPOINT_REQUIRE(window > 0 && window <= letters_max,
                    "a mailbox sender's window holds at least one letter and at most 65536");
  number_ = node_->add_socket(*this);
}

Status SenderCore::begin_letter(const Deadline& deadline) {
  if (!begin(kernel::Operation::send, sending_)) return Status::closed;
  if (link_ == nullptr) return Status::no_route;
  const Status status = wait(sending_, deadline, [&] { return room_ > 0 || status_ != Status::ok; });
  return status != Status::ok ? status : status_;
}

void SenderCore::send(std::uint64_t type, std::vector<std::byte> letter, std::uint64_t hash) {
  --room_;
  record_sent(to_string(address_), hash);
  const std::size_t size = letter.size();
  link_->send_in_order(size, {.kind = PacketKind::letter,
                              .from = {.socket = number_},
                              .to = {.port = address_.port},
                              .number = type,
                              .bytes = std::move(letter)});
}

void SenderCore::take_letter(Node& node, Link& link, Packet& packet) {
  auto* const box = static_cast<LetterBox*>(node.find(Protocol::mailbox, packet.to.port));
  const Receipt receipt{node.link_to(link.from()), packet.from.socket};
  if (box != nullptr)
    box->arrive(packet.number, packet.bytes, receipt);
  else
    receipt.send(Status::refused);
}

void SenderCore::take_receipt(Node& node, Link&, Packet& packet) {
  auto* const sender = static_cast<SenderCore*>(node.socket(packet.to.socket));
  if (sender == nullptr) return;
  const auto status = static_cast<Status>(packet.number);
  if (status == Status::ok)
    ++sender->room_;
  else if (sender->status_ == Status::ok)
    sender->status_ = status;
  sender->wake_all(sender->sending_);
}

Events SenderCore::ready() const {
  return when(room_ > 0 || status_ != Status::ok, Events::writable) | when(status_ != Status::ok, Events::closed);
}

}  // namespace waitpoint::io
