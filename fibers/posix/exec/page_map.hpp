// SPDX-License-Identifier: BSD-3-Clause
// What the system tells of the pages of this process: /proc/self/pagemap. No function of a library is called.
#pragma once

#include <cstddef>
#include <cstdint>

namespace waitpoint::posix {

inline constexpr std::size_t page_bytes = 4096;

struct Pages {
  std::uintptr_t begin, end;
  std::size_t count() const { return (end - begin) / page_bytes; }
};

class PageMap {
 public:
  struct Entry {
    std::uint64_t bits;
    bool is_present() const { return (bits >> 63 & 1) != 0; }
    bool is_swapped() const { return (bits >> 62 & 1) != 0; }
    /// As the file has it; for other memory: shared with other processes by intention.
    bool is_of_file() const { return (bits >> 61 & 1) != 0; }
    /// No other process has it mapped, as after a fork.
    bool is_exclusive() const { return (bits >> 56 & 1) != 0; }
  };

  PageMap();
  ~PageMap();
  PageMap(const PageMap&) = delete;
  PageMap& operator=(const PageMap&) = delete;

  /// False if the system does not tell.
  bool read(std::uintptr_t from, Entry* entries, std::size_t count) const;
  /// Zeroes these pages of private memory that belongs to no file; few of them have been used.
  void zero(const Pages& pages) const;

 private:
  int descriptor_;
};

}  // namespace waitpoint::posix
