// SPDX-License-Identifier: BSD-3-Clause
// A copy of the process's own memory, from which it can be restored in place: pages that it has written since are
// copied back. These are the ones that it no longer shares with the process that it was forked from.
#pragma once

#include <cstddef>
#include <span>

#include "fibers/posix/reruns/page_map.hpp"

namespace waitpoint::posix {

/// Lives, with the copies, in memory that is no part of it. Restoring calls no function of a library.
class MemoryImage {
 public:
  /// Copies all private writable memory, apart from `excluded`, to the memory from `room` on. False if it is too large,
  /// or the system does not tell of it.
  bool take(std::span<const Pages> excluded, Pages room);
  /// True if the copy has all these pages, and they belong to no file.
  bool has_anonymous(const Pages& pages) const;
  /// False if the system does not tell which pages were written.
  bool restore(const PageMap& map);
  /// The same after a run that has written no other pages than the runs before: a page that the process no longer
  /// shares stays so.
  void restore_again() const;

 private:
  struct Range {
    Pages pages;
    char* copy;  // zeros for pages that had no contents
    std::size_t first_mark;
    bool is_of_file;
  };

  bool read_mappings(std::span<const Pages> excluded);
  bool add(Pages pages, bool is_of_file, bool grows_down, std::span<const Pages> excluded);
  template <class Visit>
  bool for_each_page(const Range& range, const PageMap& map, Visit visit);

  static constexpr std::size_t ranges_max = 512, pages_max = 16384;
  Range ranges_[ranges_max];
  std::size_t count_;
  Pages room_;
  char* next_;                 // of the room, free
  bool was_there_[pages_max];  // a mark for each page: it had contents of its own
  std::size_t marks_;
  struct Written {
    char* page;
    const char* copy;
  } written_[pages_max];
  std::size_t written_count_;
  PageMap::Entry entries_[4096];
  char text_[std::size_t{1} << 18];
};

}  // namespace waitpoint::posix
