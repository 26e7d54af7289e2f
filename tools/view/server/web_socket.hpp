// SPDX-License-Identifier: BSD-3-Clause
// One WebSocket of a web server.
#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <string>

#include "tools/view/server/request_rules.hpp"
#include "tools/view/server/socket_service.hpp"

namespace waitpoint::tools::view {

class WebSocket : public std::enable_shared_from_this<WebSocket> {
 public:
  /// `ended` is called once, `was_open` if `opened` was before.
  struct Events {
    std::function<void()> opened;
    std::function<void(const std::string& text)> received;
    std::function<void(bool was_open)> ended;
  };

  WebSocket(boost::beast::tcp_stream stream, Events events);

  /// Answers the request for it.
  void accept(const Request& request);
  /// Nothing if it is not open.
  void send(std::string text);
  /// Bytes that the other end has not taken yet.
  std::size_t queued() const { return queued_; }
  void end();

 private:
  void read();
  void write();

  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  Events events_;
  boost::beast::flat_buffer buffer_;
  std::deque<std::string> texts_;  // the first is being sent
  std::size_t queued_ = 0;
  bool is_open_ = false, is_cut_off_ = false, has_ended_ = false;
};

}  // namespace waitpoint::tools::view
