// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/heap_pages.hpp"

#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace waitpoint::run {
namespace {

using Piece = std::array<std::uint64_t, 4096>;
constexpr std::uint64_t pieces_count = 1200;

// As much as a crowd's objects, in pieces that malloc takes from the heap.
std::vector<std::unique_ptr<Piece>> allocated_pieces() {
  std::vector<std::unique_ptr<Piece>> pieces;
  for (std::uint64_t i = 0; i < pieces_count; ++i) {
    pieces.push_back(std::make_unique<Piece>());
    for (std::uint64_t k = 0; k < 4096; ++k) (*pieces.back())[k] = i * 4096 + k;
  }
  return pieces;
}

// The part of the heap on large pages.
std::uint64_t heap_on_large_pages_kib() {
  std::ifstream maps("/proc/self/smaps");
  bool in_heap = false;
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    if (!first.ends_with(':')) in_heap = line.ends_with("[heap]");
    if (std::uint64_t kib = 0; in_heap && first == "AnonHugePages:" && words >> kib) return kib;
  }
  return 0;
}

// True if the system puts memory on large pages on request.
bool system_collapses_pages() {
  constexpr std::size_t size = std::size_t{4} << 20;
  constexpr int collapse = 25;  // MADV_COLLAPSE
  constexpr int unknown_advice = 0x7FFF'FFFF;
  if (madvise(nullptr, 0, unknown_advice) == 0) return false;  // an emulator that heeds no advice
  std::string words;
  std::getline(std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled"), words);
  if (words.empty() || words.find("[never]") != std::string::npos) return false;
  void* const memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return false;
  std::memset(memory, 1, size);  // only touched pages are collapsed
  const bool collapsed = madvise(memory, size, collapse) == 0;
  munmap(memory, size);
  return collapsed;
}

// Large pages at allocation are off: else the system could supply them before the call.
TEST(HeapPages, AllocatedMemoryMovesToLargePages) {
  if (!system_collapses_pages()) GTEST_SKIP() << "the system has no MADV_COLLAPSE";
  malloc_trim(0);  // what earlier tests have freed may be on large pages already
  ASSERT_EQ(prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0), 0);
  const auto pieces = allocated_pieces();
  ASSERT_EQ(prctl(PR_SET_THP_DISABLE, 0, 0, 0, 0), 0);
  const std::uint64_t before_kib = heap_on_large_pages_kib();
  put_heap_on_large_pages();
  // All of the pieces except those at the two ends of the heap.
  constexpr std::uint64_t pieces_kib = pieces_count * sizeof(Piece) / 1024;
  EXPECT_GE(heap_on_large_pages_kib(), before_kib + pieces_kib / 2);
}

TEST(HeapPages, LaterAllocationsAreOnLargePagesAfterGrowth) {
  if (!system_collapses_pages()) GTEST_SKIP() << "the system has no large pages on request";
  constexpr std::uint64_t pieces_kib = pieces_count * sizeof(Piece) / 1024;
  grow_heap_on_large_pages(2 * pieces_kib * 1024);
  const std::uint64_t before_kib = heap_on_large_pages_kib();
  const auto pieces = allocated_pieces();
  EXPECT_GE(heap_on_large_pages_kib(), before_kib + pieces_kib / 2);
}

TEST(HeapPages, ContentsAreUnchanged) {
  const auto pieces = allocated_pieces();
  for (int times = 0; times < 2; ++times) put_heap_on_large_pages();
  for (std::uint64_t i = 0; i < pieces_count; ++i)
    for (std::uint64_t k = 0; k < 4096; ++k) ASSERT_EQ((*pieces[i])[k], i * 4096 + k);
  auto later = std::make_unique<Piece>();
  later->fill(7);
  EXPECT_EQ(later->back(), 7u);
}

}  // namespace
}  // namespace waitpoint::run
