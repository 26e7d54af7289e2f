// SPDX-License-Identifier: BSD-3-Clause
// Text that is compressed while it is written (gzip), and bytes as base64.
#pragma once

#include <zlib.h>

#include <string>
#include <string_view>

namespace waitpoint::tools::view {

class CompressedText {
 public:
  CompressedText();
  ~CompressedText();
  CompressedText(const CompressedText&) = delete;
  CompressedText& operator=(const CompressedText&) = delete;

  void append(std::string_view text);
  /// The compressed bytes. Nothing can be appended afterwards.
  std::string finish();
  /// Compressed bytes so far, without the bytes that the compressor holds.
  std::size_t size() const { return bytes_.size(); }

 private:
  void run(int flush);

  z_stream stream_{};
  std::string bytes_;
};

/// RFC 4648, in one line.
std::string base64(std::string_view bytes);

}  // namespace waitpoint::tools::view
