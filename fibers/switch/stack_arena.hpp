// SPDX-License-Identifier: BSD-3-Clause
// The stacks of all fibers, in address ranges reserved once.
//
// One range per size class (the vast one of StackSize::program is reserved at its first use), divided into slots of
// equal size, reused last in, first out, so that their pages are warm:
//
//   low                                                                  high
//   | guard page |  ... grows down ...  stack | shift |   | guard page | ...
//
// Memory is committed at the first touch. The top of a stack is shifted by a varying number of cache lines: tops at the
// same offset of their pages would share a few cache sets, whose misses cost more than the switch itself.
//
// The guard page is installed by MADV_GUARD_INSTALL (Linux 6.13), which needs no mapping of its own; else by mprotect,
// up to the number of mappings a process may have; else there is none, and a canary word at the low end is checked at
// every switch. So it is, too, if the page is more than a quarter of the slot: processors of ARM have pages of 16 or
// 64 KiB in some systems.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fibers/switch/stack.hpp"

namespace waitpoint::kernel {

class StackArena {
 public:
  /// `page_bytes`: the system's size of a page, or a multiple.
  explicit StackArena(std::size_t page_bytes = system_page_bytes());
  ~StackArena();
  StackArena(const StackArena&) = delete;
  StackArena& operator=(const StackArena&) = delete;

  /// Reserves address space for stacks of every size, also of sizes that have it from their first use on only.
  void reserve_all();
  /// Installs the guards of the first stacks of each size, which stay for later arenas on the same pages (PagesKept).
  void guard_ahead(std::uint32_t slots);
  /// Takes a stack of bytes(size), minus the guard page and the shift, which is less than 4 KiB. False if all slots
  /// are in use.
  bool take(StackSize size, Stack& stack);
  void give_back(const Stack& stack);

  /// True unless the stack's canary is overwritten; always true with a guard page.
  static bool intact(const Stack& stack) {
    return __builtin_expect(stack.guard == Guard::page, 1) || canary(stack) == canary_word;
  }
  /// True if `address` is in the guard page below `stack`.
  static bool guards(const Stack& stack, const char* address);

 private:
  static std::size_t system_page_bytes();
  static constexpr std::uint64_t canary_word = 0x57A1707E57ACC0DEu;
  static std::uint64_t& canary(const Stack& stack) { return *reinterpret_cast<std::uint64_t*>(stack.low); }

  struct Range {
    char* base = nullptr;
    std::uint32_t slots = 0;   // reserved
    std::uint32_t opened = 0;  // used at least once: guarded
    std::uint32_t unguarded_from = 0xFFFFFFFF;
    std::uint32_t free_first = none;  // a list linked through the highest word of each free slot
  };
  static constexpr std::uint32_t none = 0xFFFFFFFF;

  Range& range_of(StackSize size) { return ranges_[static_cast<int>(size)]; }
  void reserve(Range& range, StackSize size);
  Stack describe(const Range& range, StackSize size, std::uint32_t slot) const;
  bool is_guarded_by_page(StackSize size) const { return page_bytes_ <= bytes(size) / 4; }
  bool install_guard(char* at);

  Range ranges_[stack_sizes];
  std::uint32_t protected_pages_ = 0;
  std::uint32_t page_bytes_;
};

}  // namespace waitpoint::kernel
