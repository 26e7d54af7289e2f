// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/library_range.hpp"

#include <link.h>

namespace waitpoint::posix {

LibraryRange range_of_library_with(const void* address) {
  struct Search {
    std::uintptr_t address;
    LibraryRange found;
  } search{reinterpret_cast<std::uintptr_t>(address), {}};
  const auto look = [](dl_phdr_info* library, std::size_t, void* to) {
    auto& sought = *static_cast<Search*>(to);
    LibraryRange range{UINTPTR_MAX, 0};
    for (int i = 0; i < library->dlpi_phnum; ++i) {
      const auto& part = library->dlpi_phdr[i];
      if (part.p_type != PT_LOAD) continue;
      const std::uintptr_t begin = library->dlpi_addr + part.p_vaddr;
      if (begin < range.begin) range.begin = begin;
      if (begin + part.p_memsz > range.end) range.end = begin + part.p_memsz;
    }
    if (!range.contains(sought.address)) return 0;
    sought.found = range;
    return 1;
  };
  dl_iterate_phdr(look, &search);
  return search.found;
}

}  // namespace waitpoint::posix
