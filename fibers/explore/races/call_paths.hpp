// SPDX-License-Identifier: BSD-3-Clause
// Compact call stacks: each call path of an access has a number, and is stored as its caller's number and one return
// address. Paths persist across runs: the same code reuses them.
//
// A task's call stack is an array of return addresses; the number of a path is looked up only at an access.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fibers/explore/races/hash_table.hpp"

namespace waitpoint::races {

class CallPaths {
 public:
  /// The path that extends `caller` by a call that returns to `address`; 0 is the path without calls.
  std::uint32_t extend(std::uint32_t caller, std::uint64_t address) {
    std::uint32_t& found = children_[(address << 16 ^ caller * 0x9E3779B97F4A7C15u) | 1];
    // Collisions of keys are rare, and chained.
    for (std::uint32_t at = found; at != 0; at = paths_[at].same_key)
      if (paths_[at].caller == caller && paths_[at].address == address) return at;
    if (paths_.size() == 0) paths_.add();
    const std::uint32_t made = paths_.add();
    paths_[made] = {address, caller, found};
    return found = made;
  }
  /// Writes the path's return addresses to `addresses`, innermost first, at most `room`; returns their number.
  std::size_t write(std::uint32_t path, void** addresses, std::size_t room) {
    std::size_t count = 0;
    for (; path != 0 && count < room; path = paths_[path].caller)
      addresses[count++] = reinterpret_cast<void*>(paths_[path].address);
    return count;
  }

 private:
  struct Path {
    std::uint64_t address;
    std::uint32_t caller;
    std::uint32_t same_key;
  };
  HashTable<std::uint32_t> children_;
  Table<Path> paths_;
};

/// A task's present calls. Beyond `depth_max` they are only counted.
class CallStack {
 public:
  static constexpr std::uint32_t depth_max = 1000;

  void enter(std::uint64_t address) {
    if (depth_ < depth_max) calls_[depth_] = {address, 0};
    ++depth_;
    path_ = 0;
  }
  void leave() {
    if (depth_ != 0) --depth_;
    path_ = depth_ != 0 && depth_ <= depth_max ? calls_[depth_ - 1].path : 0;
  }
  void clear() { depth_ = path_ = 0; }

  /// Its path.
  std::uint32_t path(CallPaths& paths) { return __builtin_expect(path_ != 0, 1) ? path_ : path_ = seek(paths); }

 private:
  struct Call {
    std::uint64_t address;
    std::uint32_t path;  // 0: not looked up yet
  };

  [[gnu::noinline]] std::uint32_t seek(CallPaths& paths) {
    const std::uint32_t depth = depth_ < depth_max ? depth_ : depth_max;
    std::uint32_t known = depth;
    while (known != 0 && calls_[known - 1].path == 0) --known;
    std::uint32_t path = known == 0 ? 0 : calls_[known - 1].path;
    for (; known < depth; ++known) path = calls_[known].path = paths.extend(path, calls_[known].address);
    return path;
  }

  std::uint32_t depth_ = 0;
  std::uint32_t path_ = 0;  // 0: not looked up yet, or no calls
  Call calls_[depth_max];
};

}  // namespace waitpoint::races
