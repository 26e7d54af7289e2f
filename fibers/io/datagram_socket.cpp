// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/datagram_socket.hpp"

#include <algorithm>

namespace waitpoint::io {

DatagramCore::DatagramCore(Network& network, const DatagramOptions& options)
    : Channel("datagram socket", ""), node_(network.own_node()), options_(options) {
  WAITPOINT_REQUIRE(options.queue_max > 0 && options.queue_max <= datagrams_max,
                    "a datagram socket's queue holds at least one datagram and at most 65536");
  WAITPOINT_REQUIRE(options.message_bytes_max <= datagram_bytes_max, "a datagram has at most 65507 bytes");
  number_ = node_->add_socket(*this);
}

DatagramCore::~DatagramCore() { node_->remove_socket(number_); }

Status DatagramCore::bind(const std::string& port) {
  if (!begin(kernel::Operation::open, receiving_)) return Status::closed;
  WAITPOINT_REQUIRE(port_.empty(), "a datagram socket is bound a second time");
  if (!node_->bind(Protocol::datagram, port, *this)) return Status::address_in_use;
  port_ = port;
  set_label(node_->name() + ":" + port);
  return Status::ok;
}

Status DatagramCore::send_to(const Address& address, std::span<const std::byte> data) {
  if (!begin(kernel::Operation::send, sending_)) return Status::closed;
  if (closed_) return Status::closed;
  if (data.size() > options_.message_bytes_max) return Status::message_too_long;
  Link* const link = node_->link_to(address.robot);
  if (link == nullptr) return Status::no_route;
  Digest sent;
  sent.add(std::string_view(reinterpret_cast<const char*>(data.data()), data.size()));
  record_sent(to_string(address), sent.value());
  link->send_datagram(data.size(), {.kind = PacketKind::datagram,
                                    .from = {.port = port_},
                                    .to = {.port = address.port},
                                    .bytes = {data.begin(), data.end()}});
  return Status::ok;
}

void DatagramCore::take_datagram(Node& node, Link& link, Packet& packet) {
  auto* const socket = static_cast<DatagramCore*>(node.find(Protocol::datagram, packet.to.port));
  if (socket != nullptr)
    socket->arrive({std::move(packet.bytes), {std::string(link.from()), std::move(packet.from.port)}});
  else
    ++link.statistics.unreachable;
}

void DatagramCore::arrive(Message message) {
  if (queue_.size() == options_.queue_max) {
    ++dropped_;
    return;
  }
  queue_.push_back(std::move(message));
  wake_one_for_arrival(receiving_);
}

Result<Datagram> DatagramCore::receive(std::span<std::byte> buffer, const Deadline& deadline) {
  if (!begin(kernel::Operation::receive, receiving_)) return Status::closed;
  const Status status = wait(receiving_, deadline, [&] { return closed_ || !queue_.empty(); });
  if (status != Status::ok) return status;
  if (closed_) return Status::closed;
  Message message = std::move(queue_.front());
  queue_.pop_front();
  const std::size_t size = std::min(buffer.size(), message.bytes.size());
  std::copy_n(message.bytes.data(), size, buffer.data());
  return Datagram{size, size < message.bytes.size(), std::move(message.from)};
}

void DatagramCore::close() {
  const bool tell = begin_release(kernel::Operation::close, receiving_);
  if (!port_.empty()) node_->release(Protocol::datagram, port_);
  closed_ = true;
  if (tell) wake_all(receiving_);
}

Events DatagramCore::ready() const {
  return when(closed_ || !queue_.empty(), Events::readable) | Events::writable | when(closed_, Events::closed);
}

datagram_socket& datagram_socket::operator=(datagram_socket&& other) noexcept {
  if (core_ != nullptr && core_ != other.core_) core_->close();
  core_ = std::move(other.core_);
  return *this;
}

datagram_socket::~datagram_socket() {
  if (core_ != nullptr) core_->close();
}

void datagram_socket::close() {
  const auto core = use();
  core_ = nullptr;
  core->close();
}

}  // namespace waitpoint::io
