// SPDX-License-Identifier: BSD-3-Clause
#include "core/printable_line.hpp"

namespace waitpoint {

std::string printable_line(std::string_view text) {
  std::string line(text);
  for (char& c : line)
    if ((c >= '\0' && c < ' ') || c == '\x7f') c = '?';
  return line;
}

}  // namespace waitpoint
