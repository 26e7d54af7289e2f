// SPDX-License-Identifier: BSD-3-Clause
// A text that the program reads in place of a file of the system's.
#pragma once

#include <cstddef>
#include <cstdint>

namespace waitpoint::posix {

class TextFile {
 public:
  /// An unnamed file in memory.
  TextFile();
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  [[gnu::format(printf, 2, 3)]] void add(const char* format, ...);
  /// A descriptor of the text from its beginning, to be closed by the caller; -1 with errno set if there was no memory.
  int finish(bool close_on_exec);

 private:
  int descriptor_;
};

/// Reads a file of the system's: at most `size` - 1 bytes and a null. False if there is none.
bool read_system_file(const char* path, char* text, std::size_t size);

}  // namespace waitpoint::posix
