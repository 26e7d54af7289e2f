// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/server/web_socket.hpp"

#include <boost/asio/post.hpp>
#include <utility>

namespace waitpoint::tools::view {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;

namespace {

// A client that has so much to take is dead or far too slow.
constexpr std::size_t queued_bytes_max = 256 << 20;

}  // namespace

WebSocket::WebSocket(beast::tcp_stream stream, Events events) : socket_(std::move(stream)), events_(std::move(events)) {
  socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
  socket_.read_message_max(SocketService::message_bytes_max);
  socket_.auto_fragment(false);
}

void WebSocket::accept(const Request& request) {
  socket_.async_accept(request, [self = shared_from_this()](error_code error) {
    if (error) return self->end();
    self->is_open_ = true;
    self->events_.opened();
    self->read();
  });
}

void WebSocket::read() {
  socket_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
    if (error) return self->end();
    const std::string text = beast::buffers_to_string(self->buffer_.data());
    self->buffer_.consume(self->buffer_.size());
    self->events_.received(text);
    if (!self->has_ended_) self->read();
  });
}

void WebSocket::send(std::string text) {
  if (!is_open_ || has_ended_ || is_cut_off_) return;
  queued_ += text.size();
  if (queued_ > queued_bytes_max) {
    is_cut_off_ = true;
    // Later: the sender may be going through all its clients.
    asio::post(socket_.get_executor(), [self = shared_from_this()] { self->end(); });
    return;
  }
  texts_.push_back(std::move(text));
  if (texts_.size() == 1) write();
}

void WebSocket::write() {
  socket_.async_write(asio::buffer(texts_.front()), [self = shared_from_this()](error_code error, std::size_t) {
    if (error) return self->end();
    self->queued_ -= self->texts_.front().size();
    self->texts_.pop_front();
    if (!self->texts_.empty() && !self->has_ended_) self->write();
  });
}

void WebSocket::end() {
  if (std::exchange(has_ended_, true)) return;
  const std::shared_ptr<WebSocket> self = shared_from_this();
  beast::get_lowest_layer(socket_).close();
  events_.ended(is_open_);
}

}  // namespace waitpoint::tools::view
