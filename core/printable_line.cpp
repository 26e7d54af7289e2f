// SPDX-License-Identifier: BSD-3-Clause
#include "core/printable_line.hpp"

namespace waitpoint {

std::string printable_line(std::string_view text) {
  std::string line(text);
  for (char& c : line)
    if ((c >= '\0' && c < ' ') || c == '\x7f') c = '?';
  return line;
}

std::string printable_message(std::string_view text) {
  constexpr std::size_t quoted_max = 80, size_max = 500;
  std::string line;
  // A quotation begins behind a blank or a parenthesis, unlike an apostrophe.
  for (std::size_t at = 0; at < text.size();) {
    const bool begins = text[at] == '\'' && (at == 0 || text[at - 1] == ' ' || text[at - 1] == '(');
    const std::size_t end = begins ? text.find('\'', at + 1) : std::string_view::npos;
    const std::size_t size = end == std::string_view::npos ? text.size() - at : end - at;
    if (begins && size > quoted_max + 1) {
      line += text.substr(at, quoted_max + 1);
      line += "...";
      at += size;
    } else {
      line += text[at++];
    }
  }
  if (line.size() > size_max) {
    line.resize(size_max);
    line += "...";
  }
  return printable_line(line);
}

}  // namespace waitpoint
