// SPDX-License-Identifier: BSD-3-Clause
// The memory that somebody touches whenever his turn comes, told beforehand, so that it can be fetched into the cache
// while others have theirs. It changes how long a turn takes and nothing else: what is fetched is not read, and may be
// gone by then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace waitpoint {

/// Consecutive cache lines.
struct CacheLines {
  static constexpr std::uintptr_t bytes = 64;

  std::uint64_t first : 52, count : 12;  ///< the address of the first is that times their size
};

class WorkingSet {
 public:
  void add(const void* address, std::size_t size) {
    if (size == 0) return;
    const auto from = reinterpret_cast<std::uintptr_t>(address), last = from + size - 1;
    lines_.push_back({from / CacheLines::bytes, last / CacheLines::bytes - from / CacheLines::bytes + 1});
  }
  /// What lies from one address to another.
  void add_between(const void* from, const void* to) {
    const auto first = reinterpret_cast<std::uintptr_t>(from), end = reinterpret_cast<std::uintptr_t>(to);
    if (first < end) add(from, end - first);
  }
  /// That much of the caller's stack, where the functions lie that it calls.
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
