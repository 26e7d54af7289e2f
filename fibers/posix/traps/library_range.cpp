// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/library_range.hpp"

#include <link.h>

#include <cstring>

#include "core/error.hpp"

namespace waitpoint::posix {
LibraryRange range_of_loaded(const dl_phdr_info& library) {
  LibraryRange range{UINTPTR_MAX, 0};
  for (int i = 0; i < library.dlpi_phnum; ++i) {
    const auto& part = library.dlpi_phdr[i];
    if (part.p_type != PT_LOAD) continue;
    const std::uintptr_t begin = library.dlpi_addr + part.p_vaddr;
    if (begin < range.begin) range.begin = begin;
    if (begin + part.p_memsz > range.end) range.end = begin + part.p_memsz;
  }
  WAITPOINT_CHECK(range.begin <= range.end, "a library is loaded that lies nowhere");
  return range;
}

namespace {

/// The library that is searched for, and its range.
struct Search {
  std::uintptr_t address;
  const char* beginning;  ///< of the file's name; null: search by the address
  LibraryRange found;
};

bool is_sought(const Search& search, const dl_phdr_info& library) {
  if (search.beginning == nullptr) return range_of_loaded(library).contains(search.address);
  const char* const slash = std::strrchr(library.dlpi_name, '/');
  const char* const name = slash != nullptr ? slash + 1 : library.dlpi_name;
  return std::strncmp(name, search.beginning, std::strlen(search.beginning)) == 0;
}

LibraryRange found_by(Search search) {
  const auto look = [](dl_phdr_info* library, std::size_t, void* to) {
    auto& sought = *static_cast<Search*>(to);
    if (!is_sought(sought, *library)) return 0;
    sought.found = range_of_loaded(*library);
    return 1;
  };
  dl_iterate_phdr(look, &search);
  return search.found;
}

}  // namespace

LibraryRange range_of_library_with(const void* address) {
  return found_by({reinterpret_cast<std::uintptr_t>(address), nullptr, {}});
}

LibraryRange range_of_library_named(const char* beginning) { return found_by({0, beginning, {}}); }

unsigned long long libraries_loaded() {
  unsigned long long count = 0;
  const auto look = [](dl_phdr_info* library, std::size_t, void* to) {
    *static_cast<unsigned long long*>(to) = library->dlpi_adds;
    return 1;
  };
  dl_iterate_phdr(look, &count);
  return count;
}

}  // namespace waitpoint::posix
