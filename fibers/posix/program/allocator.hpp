// SPDX-License-Identifier: BSD-3-Clause
// The allocator of a host's process, where a preloaded library such as jemalloc stands in the place of the C library's.
//
// Programs in the process of a host share it. When it locks and reads clocks depends on all that the process has
// allocated before, the host too: such calls are the host's, and no part of the run, also where a program's allocation
// causes them.
#pragma once

#include <cstdint>

namespace waitpoint::posix {

/// Begin and end of the library's code; both 0 if the allocator is the C library's, and without a host. Set before any
/// program is loaded; defined in program.cpp.
struct AllocatorCode {
  std::uintptr_t begin = 0, end = 0;
};
extern constinit AllocatorCode allocator_code;

/// True for the return address of a call that the allocator makes.
inline bool is_allocator(const void* caller) {
  const auto at = reinterpret_cast<std::uintptr_t>(caller);
  return at >= allocator_code.begin && at < allocator_code.end;
}

}  // namespace waitpoint::posix
