// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/heap_pages.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <string>

namespace waitpoint::run {
namespace {

// MADV_COLLAPSE: in the C library's headers since 2.37.
constexpr int collapse = 25;

// MADV_COLLAPSE itself ignores the system's setting.
bool are_large_pages_wanted() {
  std::string words;
  std::getline(std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled"), words);
  return words.find("[madvise]") != std::string::npos || words.find("[always]") != std::string::npos;
}

// The heap precedes the stacks, of which there may be a million: the search ends early. Null without a heap.
char* begin_of_heap() {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);)
    if (line.ends_with("[heap]")) return reinterpret_cast<char*>(std::strtoull(line.c_str(), nullptr, 16));
  return nullptr;
}

}  // namespace

void put_heap_on_large_pages() {
  if (!are_large_pages_wanted()) return;
  char* const begin = begin_of_heap();
  char* const end = static_cast<char*>(sbrk(0));
  if (begin != nullptr && begin < end) madvise(begin, static_cast<std::size_t>(end - begin), collapse);
}

}  // namespace waitpoint::run
