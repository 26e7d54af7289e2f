// SPDX-License-Identifier: BSD-3-Clause
// Where a library of the process lies.
#pragma once

#include <cstdint>

namespace waitpoint::posix {

struct LibraryRange {
  std::uintptr_t begin, end;
  bool contains(std::uintptr_t address) const { return address >= begin && address < end; }
};

/// Of that which has this address; empty if none has.
LibraryRange range_of_library_with(const void* address);
/// Of that whose file has a name that begins so.
LibraryRange range_of_library_named(const char* beginning);
/// How many libraries were ever loaded.
unsigned long long libraries_loaded();

}  // namespace waitpoint::posix
