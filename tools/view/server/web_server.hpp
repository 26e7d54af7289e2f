// SPDX-License-Identifier: BSD-3-Clause
// A small web server: one page, and WebSockets. One thread, without waiting; the same loop watches other descriptors.
//
// It is for one person on one machine: requests need a token, which the page's address has, and a Host and an Origin
// that are the server's own, so that no other page of a browser reaches it. Connections, sizes of messages, and times
// of silence are bounded; a client that does not take its messages is known by queued().
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "tools/view/server/socket_service.hpp"

namespace waitpoint::tools::view {

struct WebServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;  ///< 0: a free one
  std::string token;
  std::string_view page;  ///< lives as long as the server shows it
};

class WebServer {
 public:
  /// Listens. Throws BadInput, naming `option`, for an address that cannot be had.
  WebServer(const WebServerOptions& options, SocketService service, const std::string& option);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// Another page, from now on.
  void set_page(std::string_view page);

  /// The page's address, with the token.
  std::string url() const;

  /// Nothing for a client that has gone.
  void send(ClientNumber client, std::string text);
  /// Bytes that the client has not taken yet; 0 if it has gone.
  std::size_t queued(ClientNumber client) const;
  void close(ClientNumber client);

  /// Calls `ready` whenever the descriptor, which stays the caller's, can be read, until it is forgotten.
  void watch(int descriptor, std::function<void()> ready);
  void forget(int descriptor);
  /// Calls `action` again and again.
  void repeat(int milliseconds, std::function<void()> action);

  /// Until stop().
  void run();
  void stop();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> all_;
};

}  // namespace waitpoint::tools::view
