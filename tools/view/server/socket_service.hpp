// SPDX-License-Identifier: BSD-3-Clause
// A kind of WebSockets that a web server offers: who may have one, and what it is for.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace waitpoint::tools::view {

/// Counts the WebSockets, from 1.
using ClientNumber = std::uint64_t;

/// The WebSockets at one path.
struct SocketService {
  std::string path;                         ///< "/live"
  std::vector<std::string> subprotocols{};  ///< of which a client must name one; none: it need not name any
  std::vector<std::string> origins{};       ///< of other pages that may connect
  std::size_t message_bytes_max = 65'536;   ///< a client that sends more is cut off
  std::function<void(ClientNumber)> opened{}, closed{};
  std::function<void(ClientNumber, std::string data, bool is_text)> received{};
  std::function<void(const std::string& origin)> refused{};  ///< a client with the token, for its origin
};

}  // namespace waitpoint::tools::view
