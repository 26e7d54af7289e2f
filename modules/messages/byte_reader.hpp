// SPDX-License-Identifier: BSD-3-Clause
// Reads little-endian values from bytes. What lies beyond their end is BadInput: the file is damaged.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace waitpoint {

class ByteReader {
 public:
  /// `name` is that of the file; both must outlive the reader.
  ByteReader(const std::string& name, std::string_view bytes) : name_(&name), bytes_(bytes) {}

  bool at_end() const { return at_ == bytes_.size(); }
  std::size_t left() const { return bytes_.size() - at_; }
  const std::string& name() const { return *name_; }

  std::string_view take(std::uint64_t count) {
    if (count > left()) reject("more bytes, found the end of a record");
    const std::string_view taken = bytes_.substr(at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return taken;
  }
  template <class Number>
  requires std::integral<Number> || std::floating_point<Number> Number number() {
    static_assert(std::endian::native == std::endian::little);
    Number number;
    std::memcpy(&number, take(sizeof number).data(), sizeof number);
    return number;
  }
  /// A text after its length of 32 bits.
  std::string_view text() { return take(number<std::uint32_t>()); }
  /// Skips to a multiple of `size` from the beginning.
  void align(std::size_t size) {
    while (at_ % size != 0) take(1);
  }
  [[noreturn]] void reject(const std::string& expected) const { throw BadInput(*name_, "expected " + expected); }

 private:
  const std::string* name_;
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace waitpoint
