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

namespace waitpoint::tools::view {

class WebSocket : public std::enable_shared_from_this<WebSocket> {
 public:
  /// `ended` is called once, `was_open` if `opened` was before.
  struct Events {
    std::function<void()> opened;
    std::function<void(std::string data, bool is_text)> received;
    std::function<void(bool was_open)> ended;
  };

  WebSocket(boost::beast::tcp_stream stream, std::size_t message_bytes_max, Events events);

  /// Answers the request for it.
  void accept(const Request& request, const std::string& subprotocol);
  /// Nothing if it is not open.
  void send(std::string data, bool is_text);
  /// Bytes that the other end has not taken yet.
  std::size_t queued() const { return queued_; }
  void end();

 private:
  struct Message {
    std::string data;
    bool is_text;
  };

  void read();
  void write();

  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  Events events_;
  boost::beast::flat_buffer buffer_;
  std::deque<Message> messages_;  // the first is being sent
  std::size_t queued_ = 0;
  bool is_open_ = false, is_cut_off_ = false, has_ended_ = false;
};

}  // namespace waitpoint::tools::view
