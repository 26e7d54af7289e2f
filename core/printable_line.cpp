// SPDX-License-Identifier: BSD-3-Clause
#include "core/printable_line.hpp"

#include <cstdint>

namespace waitpoint {
namespace {

struct Letter {
  std::size_t size = 1;         // in bytes
  std::uint32_t code = 0xFFFD;  // the replacement character for what is no UTF-8
};

/// The first character of a text in UTF-8. Forms that are longer than needed are none.
Letter first_letter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return {1, byte(0)};
  const std::size_t size = byte(0) < 0xC2 ? 1 : byte(0) < 0xE0 ? 2 : byte(0) < 0xF0 ? 3 : byte(0) < 0xF5 ? 4 : 1;
  if (size == 1 || size > text.size()) return {};
  std::uint32_t code = byte(0) & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3FU);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  if (code < least[size]) return {};
  return {size, code};
}

bool is_harmless(std::uint32_t code) {
  const bool controls = code < 0x20 || (code >= 0x7F && code < 0xA0);
  // Line and paragraph separators, and what turns the direction of writing.
  const bool reorders = (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
  return !controls && !reorders;
}

}  // namespace

std::string printable_line(std::string_view text) {
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const Letter letter = first_letter(text.substr(at));
    const bool is_text = letter.size > 1 || letter.code < 0x80;
    line += is_text && is_harmless(letter.code) ? text.substr(at, letter.size) : "?";
    at += letter.size;
  }
  return line;
}

bool is_printable_line(std::string_view text) { return printable_line(text) == text; }

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
