// SPDX-License-Identifier: BSD-3-Clause
// Texts in JSON.
#pragma once

#include <string>
#include <string_view>

namespace waitpoint::exploration {

/// The text in quotation marks; control characters other than ends of lines are left out.
inline std::string json_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (c == '\n')
      quoted += "\\n";
    else if (static_cast<unsigned char>(c) >= 0x20)
      quoted += c;
  }
  return quoted + "\"";
}

}  // namespace waitpoint::exploration
