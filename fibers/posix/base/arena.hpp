// SPDX-License-Identifier: BSD-3-Clause
// An allocator for the explorer's data, apart from the program's heap, so that the program's addresses do not depend on
// how much a strategy stores. It is part of the file shared by the program and `waitpoint`, mapped at one address in
// both: a schedule can be read however the run has ended.
#pragma once

#include <bit>
#include <cstddef>
#include <new>

namespace waitpoint::posix {

class Arena {
 public:
  /// From `begin` to `end`, aligned for anything.
  void start(void* begin, void* end) {
    next_ = static_cast<char*>(begin);
    end_ = static_cast<char*>(end);
  }

  /// Aligned for anything; null where the arena is full.
  void* take(std::size_t size) {
    const auto number = static_cast<std::size_t>(std::bit_width(size + head_bytes - 1));
    if (number >= classes) return nullptr;
    if (Free* const found = free_[number]; found != nullptr) {
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
    const std::size_t number = *reinterpret_cast<std::size_t*>(static_cast<char*>(memory) - head_bytes);
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

  char* next_ = nullptr;
  char* end_ = nullptr;
  Free* free_[classes] = {};
};

}  // namespace waitpoint::posix
