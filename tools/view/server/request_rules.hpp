// SPDX-License-Identifier: BSD-3-Clause
// Which requests a web server answers, and how: one page, and WebSockets, for who has the token.
#pragma once

#include <boost/beast/http.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "tools/view/server/socket_service.hpp"

namespace waitpoint::tools::view {

using Request = boost::beast::http::request<boost::beast::http::string_body>;
using Response = boost::beast::http::response<boost::beast::http::string_body>;

struct RequestRules {
  std::string host, local_host;  ///< "127.0.0.1:1234", "localhost:1234"
  bool is_any_address = false;   ///< it listens at all of the machine's addresses: each may be the host
  std::string token;
  std::string_view page;

  /// "/live", of a request.
  static std::string_view path(const Request& request);

  /// To a request that does not become a WebSocket.
  Response answer(const Request& request) const;
  /// Why a request does not become a WebSocket of `service`; nothing: it does.
  std::optional<Response> refusal(const Request& request, const SocketService& service) const;
  /// Tells of a status other than success.
  static Response error(const Request& request, boost::beast::http::status status, const std::string& text);
  /// The first subprotocol that the client names and the service speaks; "" if there is none.
  static std::string subprotocol(const Request& request, const SocketService& service);

 private:
  bool knows(std::string_view text) const;
  bool has_token(const Request& request) const;
  bool is_own(std::string_view origin) const;
};

}  // namespace waitpoint::tools::view
