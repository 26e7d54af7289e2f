// SPDX-License-Identifier: BSD-3-Clause
// The memory that a task touches at each turn, declared beforehand so that the kernel can fetch it into the cache
// during other tasks' turns. It affects speed only: the memory is prefetched, not read, and may be freed by then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace waitpoint {

/// Consecutive cache lines.
struct CacheLines {
  static constexpr std::uintptr_t bytes = 64;

  std::uint64_t first : 52, count : 12;  ///< the index of the first line: its address / bytes
};

class WorkingSet {
 public:
  void add(const void* address, std::size_t size) {
    if (size == 0) return;
    const auto from = reinterpret_cast<std::uintptr_t>(address), last = from + size - 1;
    lines_.push_back({from / CacheLines::bytes, last / CacheLines::bytes - from / CacheLines::bytes + 1});
  }
  /// Adds the memory between two addresses.
  void add_between(const void* from, const void* to) {
    const auto first = reinterpret_cast<std::uintptr_t>(from), end = reinterpret_cast<std::uintptr_t>(to);
    if (first < end) add(from, end - first);
  }
  /// Adds `size` bytes of stack below the caller's frame, for the functions that it calls.
  void add_stack_below(std::size_t size) {
    const char* const here = static_cast<const char*>(__builtin_frame_address(0));
    add(here - size, size);
  }
  template <class T>
  void add(const T& object) {
    add(&object, sizeof object);
  }
  std::span<const CacheLines> lines() const { return lines_; }

 private:
  std::vector<CacheLines> lines_;
};

}  // namespace waitpoint
