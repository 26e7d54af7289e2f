// SPDX-License-Identifier: BSD-3-Clause
// The memory of one stack, allocated by the arena.
#pragma once

#include <cstddef>
#include <cstdint>

namespace waitpoint::kernel {

/// 16, 64, 256 KiB, and 8 MiB, the default of a system's threads.
enum class StackSize : std::uint8_t { small, medium, large, program };
inline constexpr int stack_sizes = 4;

constexpr std::size_t bytes(StackSize size) {
  return size == StackSize::program ? std::size_t{8} << 20 : std::size_t{16384} << (2 * static_cast<int>(size));
}

enum class Guard : std::uint8_t { page, canary };

struct Stack {
  char* low = nullptr;   ///< lowest usable byte
  char* high = nullptr;  ///< one past the highest, aligned to 64 bytes
  std::uint32_t slot = 0;
  StackSize size = StackSize::medium;
  Guard guard = Guard::page;
  std::uint16_t guard_kib = 4;  ///< the size of the guard below `low`
};

}  // namespace waitpoint::kernel
