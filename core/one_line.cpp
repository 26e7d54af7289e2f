// SPDX-License-Identifier: BSD-3-Clause
#include "core/one_line.hpp"

namespace waitpoint {

std::string one_line(std::string_view text) {
  std::string line(text);
  for (char& c : line)
    if ((c >= '\0' && c < ' ') || c == '\x7f') c = '?';
  return line;
}

}  // namespace waitpoint
