// SPDX-License-Identifier: BSD-3-Clause
// The memory of what explores a program, apart from the program's own: however much a strategy keeps, the program's
// addresses are the same. It lies in the file that the program shares with who started it, at one address in both, so
// that a schedule can be read however the run has ended.
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

  /// Back for others of its size.
  void give(void* memory) {
    if (memory == nullptr) return;
    const std::size_t number = *reinterpret_cast<std::size_t*>(static_cast<char*>(memory) - head_bytes);
    free_[number] = new (memory) Free{free_[number]};
  }

  /// So far it reaches.
  const void* top() const { return next_; }

 private:
  struct Free {
    Free* next;
  };
  static constexpr std::size_t classes = 40;     // powers of two
  static constexpr std::size_t head_bytes = 16;  // in front of each piece: of which class it is

  char* next_ = nullptr;
  char* end_ = nullptr;
  Free* free_[classes] = {};
};

}  // namespace waitpoint::posix
