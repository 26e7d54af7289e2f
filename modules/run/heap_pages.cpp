// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/heap_pages.hpp"

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

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

struct Mapping {
  char *begin, *end;
};

// More than one where the process is a fork. The heap precedes the stacks, of which there may be a million: the search
// ends early.
std::vector<Mapping> heap() {
  std::vector<Mapping> parts;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    if (!line.ends_with("[heap]")) {
      if (!parts.empty()) break;
      continue;
    }
    char* after = nullptr;
    char* const begin = reinterpret_cast<char*>(std::strtoull(line.c_str(), &after, 16));
    parts.push_back({begin, reinterpret_cast<char*>(std::strtoull(after + 1, nullptr, 16))});
  }
  return parts;
}

}  // namespace

void grow_heap_on_large_pages(std::size_t bytes) {
  constexpr std::size_t bytes_max = std::size_t{1} << 30, piece = std::size_t{64} << 10, pieces_max = 1024;
  if (!are_large_pages_wanted()) return;
  const int padding = static_cast<int>(std::min(bytes, bytes_max));
  mallopt(M_TOP_PAD, padding);
  mallopt(M_TRIM_THRESHOLD, padding);
  // malloc() grows the heap, by the padding, when the free memory at its end does not suffice.
  const void* const end = sbrk(0);
  std::vector<std::unique_ptr<char[]>> pieces;
  while (sbrk(0) == end && pieces.size() < pieces_max) pieces.push_back(std::make_unique_for_overwrite<char[]>(piece));
  for (const Mapping part : heap()) madvise(part.begin, static_cast<std::size_t>(part.end - part.begin), MADV_HUGEPAGE);
}

void put_heap_on_large_pages() {
  if (!are_large_pages_wanted()) return;
  for (const Mapping part : heap()) madvise(part.begin, static_cast<std::size_t>(part.end - part.begin), collapse);
}

}  // namespace waitpoint::run
