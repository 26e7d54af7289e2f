// SPDX-License-Identifier: BSD-3-Clause
// Fields as bytes, from a program to itself in another process.
#pragma once

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/error.hpp"

namespace waitpoint::tools {

/// Both are called with each field, in the same order.
class FieldWriter {
 public:
  template <class T>
  void operator()(const T& value) requires std::is_trivially_copyable_v<T> {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void operator()(const std::string& text) { put(text); }
  template <class T>
  void operator()(const std::vector<T>& values) requires std::is_trivially_copyable_v<T> {
    put(values);
  }
  std::string bytes;

 private:
  template <class Sequence>
  void put(const Sequence& sequence) {
    (*this)(sequence.size());
    bytes.append(reinterpret_cast<const char*>(sequence.data()), sequence.size() * sizeof *sequence.data());
  }
};

class FieldReader {
 public:
  explicit FieldReader(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  void operator()(T& value) requires std::is_trivially_copyable_v<T> {
    take(&value, sizeof value);
  }
  void operator()(std::string& text) { get(text); }
  template <class T>
  void operator()(std::vector<T>& values) requires std::is_trivially_copyable_v<T> {
    get(values);
  }
  bool is_at_end() const { return rest_.empty(); }

 private:
  void take(void* to, std::size_t size) {
    WAITPOINT_CHECK(size <= rest_.size(), "a message is shorter than it says");
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  template <class Sequence>
  void get(Sequence& sequence) {
    std::size_t size = 0;
    (*this)(size);
    sequence.resize(size);
    take(sequence.data(), size * sizeof *sequence.data());
  }
  std::string_view rest_;
};

}  // namespace waitpoint::tools
