// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/stream_listener.hpp"

namespace waitpoint::io {

Listener::Listener(Network& network, const ListenOptions& options)
    : Channel("stream listener", ""), node_(network.own_node()), options_(options) {
  WAITPOINT_REQUIRE(options.backlog > 0, "the backlog of a listener must be at least 1");
  number_ = node_->add_socket(*this);
}

Listener::~Listener() { node_->remove_socket(number_); }

Status Listener::listen(const std::string& port) {
  if (!begin(kernel::Operation::open, receiving_)) return Status::closed;
  WAITPOINT_REQUIRE(port_.empty(), "a stream listener listens a second time");
  if (!node_->bind(Protocol::stream, port, *this)) return Status::address_in_use;
  port_ = port;
  set_label(node_->name() + ":" + port);
  return Status::ok;
}

Stream* Listener::accept_request(Link& back) {
  if (backlog_.size() == options_.backlog || !node_->has_room()) return nullptr;
  backlog_.push_back(std::make_shared<Stream>(node_, back, options_.stream, node_->name() + ":" + port_));
  wake_one_for_arrival(receiving_);
  return backlog_.back().get();
}

Result<std::shared_ptr<Stream>> Listener::accept(const Deadline& deadline) {
  if (!begin(kernel::Operation::accept, receiving_)) return Status::closed;
  WAITPOINT_REQUIRE(!port_.empty(), "a listener accepts before it listens");
  const Status status = wait(receiving_, deadline, [&] { return closed_ || !backlog_.empty(); });
  if (status != Status::ok) return status;
  if (closed_) return Status::closed;
  std::shared_ptr<Stream> stream = std::move(backlog_.front());
  backlog_.pop_front();
  return stream;
}

void Listener::close() {
  const bool tell = begin_release(kernel::Operation::close, receiving_);
  if (!port_.empty()) node_->release(Protocol::stream, port_);
  closed_ = true;
  if (tell) wake_all(receiving_);
  for (; !backlog_.empty(); backlog_.pop_front()) backlog_.front()->close();
}

Events Listener::ready() const {
  return when(closed_ || !backlog_.empty(), Events::readable) | when(closed_, Events::closed);
}

stream_listener& stream_listener::operator=(stream_listener&& other) noexcept {
  if (core_ != nullptr && core_ != other.core_) core_->close();
  core_ = std::move(other.core_);
  return *this;
}

stream_listener::~stream_listener() {
  if (core_ != nullptr) core_->close();
}

Result<stream_socket> stream_listener::accept(const Deadline& deadline) {
  const Result<std::shared_ptr<Stream>> accepted = use()->accept(deadline);
  if (!accepted) return accepted.status();
  return stream_socket(accepted.value());
}

void stream_listener::close() {
  const auto core = use();
  core_ = nullptr;
  core->close();
}

}  // namespace waitpoint::io
