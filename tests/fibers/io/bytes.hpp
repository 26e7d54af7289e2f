// SPDX-License-Identifier: BSD-3-Clause
// Text as bytes, to send and receive in tests; and sources of numbered bytes.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "fibers/io/result.hpp"

namespace waitpoint::io {

inline std::span<const std::byte> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

/// Reads once, at most `most` bytes; returns them, or the status in brackets: "[timed out]".
template <class Reader, class... Until>
std::string read_text(Reader& from, std::size_t most = 4096, const Until&... until) {
  std::string text(most, '?');
  const Result<std::size_t> got = from.read({reinterpret_cast<std::byte*>(text.data()), text.size()}, until...);
  if (!got) return std::string("[") + to_string(got.status()) + "]";
  text.resize(got.value());
  return text;
}

/// Reads to the end of file.
template <class Reader>
std::string read_all(Reader& from, std::size_t at_a_time = 7) {
  std::string all;
  for (;;) {
    const std::string part = read_text(from, at_a_time);
    if (part == "[end of file]") return all;
    if (part.starts_with("[")) return all + part;
    all += part;
  }
}

/// `size` letters that differ by `key` and position.
inline std::string long_text(std::size_t size, unsigned key = 0) {
  std::string text(size, ' ');
  for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>('a' + (i * 7 + i / 26 + key) % 26);
  return text;
}

}  // namespace waitpoint::io
