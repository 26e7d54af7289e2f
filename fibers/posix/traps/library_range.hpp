// SPDX-License-Identifier: BSD-3-Clause
// The address range of a library of the process.
#pragma once

#include <link.h>

#include <cstdint>

namespace waitpoint::posix {

struct LibraryRange {
  std::uintptr_t begin, end;
  bool contains(std::uintptr_t address) const { return address >= begin && address < end; }
};

/// That of a library, as dl_iterate_phdr() shows it.
LibraryRange range_of_loaded(const dl_phdr_info& library);
/// The library that contains this address; empty without one.
LibraryRange range_of_library_with(const void* address);
/// The library whose file name begins so; empty without one.
LibraryRange range_of_library_named(const char* beginning);
/// The number of libraries loaded so far, unloaded ones included.
unsigned long long libraries_loaded();

}  // namespace waitpoint::posix
