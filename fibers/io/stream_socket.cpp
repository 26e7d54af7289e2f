// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/stream_socket.hpp"

namespace waitpoint::io {

Stream::Stream(std::shared_ptr<Node> node, Link& link, const StreamOptions& options, const std::string& label)
    : Channel("stream socket", label), node_(std::move(node)), link_(link), received_(options.buffer_bytes) {
  WAITPOINT_REQUIRE(options.buffer_bytes > 0 && options.buffer_bytes <= buffer_max,
                    "a stream's buffer holds at least one byte and at most 64 MiB");
  number_ = node_->add_socket(*this);
}

Stream::~Stream() { node_->remove_socket(number_); }

// The packet acts on the peer, if it still exists at the arrival.
void Stream::tell_peer(PacketKind kind, std::uint64_t number, std::span<const std::byte> bytes) {
  link_.send_in_order(bytes.size(),
                      {.kind = kind, .to = {.socket = peer_}, .number = number, .bytes = {bytes.begin(), bytes.end()}});
}

// --- connecting: see also stream_handshake.cpp ---

void Stream::establish(std::uint64_t peer, std::size_t credit) {
  peer_ = peer;
  state_ = State::open;
  credit_ = credit;
  // The caller of connect() may have given up in the meantime.
  if (closed_) tell_peer(PacketKind::peer_gone);
  wake_all(sending_);
}

void Stream::take_refusal(Packet&) {
  state_ = State::refused;
  wake_all(sending_);
}

// --- reading ---

Result<std::size_t> Stream::read(std::span<std::byte> buffer, const Deadline& deadline) {
  if (!begin(kernel::Operation::receive, receiving_)) return Status::closed;
  if (buffer.empty()) return 0;
  const Status status = wait(receiving_, deadline, [&] { return closed_ || !received_.empty() || peer_finished_; });
  if (status != Status::ok) return status;
  if (closed_) return Status::closed;
  const std::size_t count = received_.pop(buffer);
  if (count == 0) return Status::end_of_file;
  tell_peer(PacketKind::room, count + std::exchange(extra_charge_, 0));
  return count;
}

void Stream::take_data(Packet& packet) {
  if (closed_) return;
  received_.push(packet.bytes);
  extra_charge_ += packet.number - packet.bytes.size();
  wake_all(receiving_);
}

void Stream::take_end_of_data(Packet&) {
  peer_finished_ = true;
  wake_all(receiving_);
}

void Stream::take_end_of_peer(Packet&) {
  peer_finished_ = peer_gone_ = true;
  wake_all(receiving_);
  wake_all(sending_);
}

// --- writing ---

Result<std::size_t> Stream::write(std::span<const std::byte> data, const Deadline& deadline) {
  if (!begin(kernel::Operation::send, sending_)) return Status::closed;
  WAITPOINT_REQUIRE(!finished_, "a stream socket is written to after shutdown_write()");
  Digest sent;
  std::size_t written = 0;
  Status status = Status::ok;
  while (written < data.size()) {
    status = wait(sending_, deadline, [&] { return closed_ || peer_gone_ || credit_ > 0; });
    if (status == Status::ok && (closed_ || peer_gone_)) status = closed_ ? Status::closed : Status::peer_closed;
    if (status != Status::ok) break;
    const std::size_t count = std::min({data.size() - written, credit_, segment_bytes_max});
    const std::size_t charge = link_.is_between_robots() ? std::min(std::max(count, least_charge), credit_) : count;
    const auto part = data.subspan(written, count);
    credit_ -= charge;
    written += count;
    sent.add(std::string_view(reinterpret_cast<const char*>(part.data()), part.size()));
    tell_peer(PacketKind::data, charge, part);
  }
  if (written > 0) record_sent(link_.to(), sent.value());
  return {status, written};
}

void Stream::take_room(Packet& packet) {
  credit_ += packet.number;
  wake_all(sending_);
}

// --- closing ---

void Stream::shutdown_write() {
  if (!begin_release(kernel::Operation::close, sending_)) return;
  WAITPOINT_REQUIRE(!finished_, "a stream socket's writing is shut down twice");
  finished_ = true;
  tell_peer(PacketKind::end_of_data);
}

void Stream::close() {
  const bool tell = begin_release(kernel::Operation::close, receiving_);
  closed_ = true;
  if (!tell) return;
  wake_all(receiving_);
  wake_all(sending_);
  if (state_ == State::open) tell_peer(PacketKind::peer_gone);
}

Events Stream::ready() const {
  return when(closed_ || !received_.empty() || peer_finished_, Events::readable) |
         when(closed_ || peer_gone_ || (state_ == State::open && credit_ > 0), Events::writable) |
         when(closed_ || peer_gone_, Events::closed);
}

// --- handles ---

stream_socket& stream_socket::operator=(stream_socket&& other) noexcept {
  if (stream_ != nullptr && stream_ != other.stream_) stream_->close();
  stream_ = std::move(other.stream_);
  return *this;
}

stream_socket::~stream_socket() {
  if (stream_ != nullptr) stream_->close();
}

void stream_socket::close() {
  const auto stream = use();
  stream_ = nullptr;
  stream->close();
}

Result<stream_socket> connect(Network& network, const Address& address, const Deadline& deadline,
                              const StreamOptions& options) {
  const std::shared_ptr<Node> node = network.own_node();
  Link* const link = node->link_to(address.robot);
  if (link == nullptr) return Status::no_route;
  const auto stream = std::make_shared<Stream>(node, *link, options, "to " + to_string(address));
  stream_socket socket(stream);  // closes the stream on every return
  const Status status = stream->connect(address.port, deadline);
  if (status != Status::ok) return status;
  return Result<stream_socket>(std::move(socket));
}

}  // namespace waitpoint::io
