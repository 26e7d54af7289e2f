// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/compressed_text.hpp"

#include <array>
#include <cstdint>

#include "core/error.hpp"

namespace waitpoint::tools::view {

CompressedText::CompressedText() {
  constexpr int with_head_of_gzip = 15 + 16, memory = 8;
  WAITPOINT_CHECK(
      deflateInit2(&stream_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, with_head_of_gzip, memory, Z_DEFAULT_STRATEGY) == Z_OK,
      "the compressor has no memory");
}

CompressedText::~CompressedText() { deflateEnd(&stream_); }

void CompressedText::append(std::string_view text) {
  // zlib only reads it.
  stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream_.avail_in = static_cast<uInt>(text.size());
  run(Z_NO_FLUSH);
}

std::string CompressedText::finish() {
  stream_.avail_in = 0;
  run(Z_FINISH);
  return std::move(bytes_);
}

void CompressedText::run(int flush) {
  std::array<Bytef, 1 << 15> buffer;
  do {
    stream_.next_out = buffer.data();
    stream_.avail_out = buffer.size();
    deflate(&stream_, flush);
    bytes_.append(reinterpret_cast<const char*>(buffer.data()), buffer.size() - stream_.avail_out);
  } while (stream_.avail_out == 0);
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = i; j < i + 3; ++j)
      group = group << 8 | (j < bytes.size() ? static_cast<std::uint8_t>(bytes[j]) : 0);
    for (std::size_t j = 0; j < 4; ++j) text += i + j <= bytes.size() ? letters[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

}  // namespace waitpoint::tools::view
