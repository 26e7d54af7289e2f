// SPDX-License-Identifier: BSD-3-Clause
// Which requests a web server answers, and how: one page, and WebSockets, for clients with the token.
#pragma once

#include <boost/beast/http.hpp>
#include <optional>
#include <string>
#include <string_view>

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
  /// The answer to a request that may not become a WebSocket; nothing: it may.
  std::optional<Response> refusal(const Request& request) const;
  /// Tells of a status other than success.
  static Response error(const Request& request, boost::beast::http::status status, const std::string& text);

 private:
  bool knows(std::string_view text) const;
  bool has_token(const Request& request) const;
  bool is_own(std::string_view origin) const;
};

}  // namespace waitpoint::tools::view
