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
  /// Finds those of these pages of private memory, which belongs to no file, that have been used: few. `take` is called
  /// with each range of them. Pages that are not in memory are discarded, all if the system does not tell.
  template <class Take>
  void find_used(const Pages& pages, Take take) const;

 private:
  static constexpr std::size_t found_max = 64;
  struct Found {
    std::uint64_t begin, end, categories;
    bool is_in_memory() const;
  };
  /// The number of ranges; negative if the system does not tell.
  long scan(const Pages& pages, Found (&found)[found_max]) const;
  static void discard(const Pages& pages);

  int descriptor_;
};

template <class Take>
void PageMap::find_used(const Pages& pages, Take take) const {
  Found found[found_max];
  const long count = scan(pages, found);
  if (count < 0) return discard(pages);
  for (long i = 0; i < count; ++i) {
    const Pages one{found[i].begin, found[i].end};
    if (found[i].is_in_memory())
      take(one);
    else
      discard(one);  // a guard stays
  }
}

/// The number of page faults of this process so far: without any, the pages in memory are the same as before, unless
/// some were discarded, and none has become its own.
long page_faults();

}  // namespace waitpoint::posix
