// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/serve_address.hpp"

#include "core/number_text.hpp"
#include "tools/command/option_values.hpp"

namespace waitpoint::tools {

ServeAddress serve_address(const std::string& text) {
  ServeAddress found;
  if (text.empty()) return found;
  const std::size_t colon = text.rfind(':');
  const std::string port = colon != std::string::npos ? text.substr(colon + 1) : text;
  if (!parse_number(port, found.port))
    refuse("--serve", "an address and a port from 0 to 65535, as 127.0.0.1:8080", text);
  if (colon != std::string::npos && colon > 0) found.address = text.substr(0, colon);
  if (found.address == "localhost") found.address = "127.0.0.1";
  if (found.address.front() == '[' && found.address.back() == ']')
    found.address = found.address.substr(1, found.address.size() - 2);
  return found;
}

}  // namespace waitpoint::tools
