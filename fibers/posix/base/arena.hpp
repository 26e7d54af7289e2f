// SPDX-License-Identifier: BSD-3-Clause
// An allocator for the explorer's data, apart from the program's heap, so that the program's addresses do not depend on
// how much a strategy stores. It is part of the file shared by the program and `waitpoint`, mapped at one address in
// both: a schedule can be read however the run has ended.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>

#include "core/error.hpp"

namespace waitpoint::posix {

class Arena {
 public:
  /// Of each piece: for any type.
  static constexpr std::size_t alignment = alignof(std::max_align_t);

  /// From `begin`, which must be aligned, to `end`.
  void start(void* begin, void* end) {
    WAITPOINT_CHECK(reinterpret_cast<std::uintptr_t>(begin) % alignment == 0,
                    "the arena begins at an unaligned address");
    WAITPOINT_CHECK(begin <= end, "the arena ends before it begins");
    next_ = static_cast<char*>(begin);
    end_ = static_cast<char*>(end);
  }

  /// Aligned for anything; null where the arena is full.
  void* take(std::size_t size) {
    if (size > largest) return nullptr;
    const auto number = static_cast<std::size_t>(std::bit_width((size > 0 ? size : 1) + head_bytes - 1));
    if (Free* const found = free_[number]; found != nullptr) {
      WAITPOINT_CHECK(class_of(found) == number, "a free piece of the arena is in the list of another class");
      free_[number] = found->next;
      return found;
    }
    const std::size_t bytes = std::size_t{1} << number;
    if (bytes > static_cast<std::size_t>(end_ - next_)) return nullptr;
    char* const piece = next_;
    next_ += bytes;
    new (piece) std::size_t(number);
    return piece + head_bytes;
  }

  /// For reuse by pieces of the same class.
  void give(void* memory) {
    if (memory == nullptr) return;
    const std::size_t number = class_of(memory);
    WAITPOINT_CHECK(number >= smallest_class && number < classes, "memory given back is no piece of the arena");
    WAITPOINT_CHECK(memory < next_ && memory != free_[number], "a piece of the arena is given back twice");
    free_[number] = new (memory) Free{free_[number]};
  }

  /// The end of the memory in use.
  const void* top() const { return next_; }

 private:
  struct Free {
    Free* next;
  };
  static constexpr std::size_t classes = 40;     // powers of two
  static constexpr std::size_t head_bytes = 16;  // in front of each piece: its class
  static constexpr std::size_t largest = (std::size_t{1} << (classes - 1)) - head_bytes;
  static constexpr std::size_t smallest_class = std::bit_width(head_bytes);
  static_assert(classes < std::numeric_limits<std::size_t>::digits, "the size of every class is a number");
  static_assert(head_bytes >= sizeof(std::size_t) && head_bytes % alignment == 0,
                "pieces are aligned behind their head");
  static_assert((std::size_t{1} << smallest_class) - head_bytes >= sizeof(Free), "a free piece has room for its link");

  static std::size_t class_of(const void* piece) {
    return *reinterpret_cast<const std::size_t*>(static_cast<const char*>(piece) - head_bytes);
  }

  char* next_ = nullptr;
  char* end_ = nullptr;
  Free* free_[classes] = {};
};

}  // namespace waitpoint::posix
