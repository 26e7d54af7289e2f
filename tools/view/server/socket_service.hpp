// SPDX-License-Identifier: BSD-3-Clause
// The service behind a web server's WebSockets, which are at the path /live. Messages are texts.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace waitpoint::tools::view {

/// Counts the WebSockets, from 1.
using ClientNumber = std::uint64_t;

struct SocketService {
  static constexpr const char* path = "/live";
  static constexpr std::size_t message_bytes_max = 65'536;  ///< a client that sends more is cut off

  std::function<void(ClientNumber)> opened, closed;
  std::function<void(ClientNumber, const std::string& text)> received{};  ///< empty: texts are ignored
};

}  // namespace waitpoint::tools::view
