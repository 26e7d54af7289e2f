// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/heap_pages.hpp"

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>

namespace waitpoint::bridge {
namespace {

// MADV_COLLAPSE, which the C library's headers have since 2.37.
constexpr int collapse = 25;
// Less than that the processor finds on small pages.
constexpr std::size_t much = std::size_t{16} << 20;

}  // namespace

void put_heap_on_large_pages() {
  // The heap comes before the stacks, of which there may be a million.
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    if (!line.ends_with("[heap]")) continue;
    unsigned long first = 0, end = 0;
    if (std::sscanf(line.c_str(), "%lx-%lx", &first, &end) != 2 || end - first < much) return;
    void* const heap = reinterpret_cast<void*>(first);
    madvise(heap, end - first, MADV_HUGEPAGE);  // what is allocated later, too
    madvise(heap, end - first, collapse);
    return;
  }
}

}  // namespace waitpoint::bridge
