// SPDX-License-Identifier: BSD-3-Clause
// Text in memory of the caller's, cut off at its end. Needs no heap and takes no lock: for handlers of signals.
#pragma once

#include <cstddef>

namespace waitpoint::posix {

class BoundedText {
 public:
  /// In `room`, which has at least one byte; from the beginning.
  BoundedText(char* room, std::size_t size);

  /// As printf().
  [[gnu::format(printf, 2, 3)]] void add(const char* format, ...);
  std::size_t length() const { return length_; }
  /// Writes it to the error stream's descriptor.
  void write() const;

 private:
  char* room_;
  std::size_t size_, length_ = 0;
};

}  // namespace waitpoint::posix
