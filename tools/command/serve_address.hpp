// SPDX-License-Identifier: BSD-3-Clause
// The option --serve [ADDRESS:PORT] of several commands: where a page for browsers is served.
#pragma once

#include <cstdint>
#include <string>

namespace waitpoint::tools {

struct ServeAddress {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;  ///< 0: a free one
};

/// "127.0.0.1:8080", "[::1]:8080", ":8080", "8080"; empty: a free port of the loopback. BadInput names --serve.
ServeAddress serve_address(const std::string& text);

}  // namespace waitpoint::tools
