// SPDX-License-Identifier: BSD-3-Clause
// Text for the error stream, async-signal-safe, for handlers on a broken stack too: no allocation, no lock, no library
// state (POSIX.1-2017, 2.4.3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/time.hpp"

namespace waitpoint::kernel {

class SignalSafeText {
 public:
  SignalSafeText& add(std::string_view text);
  SignalSafeText& add(std::uint64_t number);
  /// In seconds, to the nanosecond.
  SignalSafeText& add(Time time);
  /// Writes the text to the error stream's descriptor, unbuffered; preserves errno. Long text is written in parts, as
  /// it is added.
  void write();

 private:
  void add_digits(std::uint64_t number, std::size_t least);

  char text_[256];
  std::size_t size_ = 0;
};

}  // namespace waitpoint::kernel
