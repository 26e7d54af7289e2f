// SPDX-License-Identifier: BSD-3-Clause
// Stacks on which accesses are reported: one for the system's frame at a breakpoint, its alternate stack, and one for
// each thread that is within a report.
#pragma once

#include <signal.h>

#include <cstddef>
#include <cstdint>

namespace waitpoint::posix {

class ReportStacks {
 public:
  static constexpr std::size_t bytes_of_one = std::size_t{1} << 16, count = 4096;
  static constexpr std::size_t bytes_of_list = std::size_t{1} << 16;
  static constexpr std::size_t bytes = count * bytes_of_one + bytes_of_list;

  /// In `kept` memory, which stays, unless it is null. False without memory.
  bool make(void* kept);
  void remove();

  /// The top of a free one; null if there is none.
  void* take();
  /// The one with this address; it may be used until the next is taken.
  void give_back(const void* within);

  /// True for an address of the system's.
  bool is_of_system(const void* address) const { return number_of(address) == 0; }
  /// Sets the system's alternate stack, if it is another.
  void keep_for_system() const;

 private:
  std::size_t number_of(const void* address) const {
    return (reinterpret_cast<std::uintptr_t>(address) - reinterpret_cast<std::uintptr_t>(memory_)) / bytes_of_one;
  }

  char* memory_ = nullptr;
  bool is_kept_ = false;
  std::size_t used_ = 1;  // the first is the system's
  std::size_t free_count_ = 0;
  std::uint16_t* free_ = nullptr;
  stack_t before_{};
};

}  // namespace waitpoint::posix
