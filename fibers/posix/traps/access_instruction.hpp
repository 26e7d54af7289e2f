// SPDX-License-Identifier: BSD-3-Clause
// An instruction of a program that accesses memory, as its operand says: found by a disassembler in the explorer's
// process, trapped in the program (access_breakpoints.hpp).
#pragma once

#include <cstdint>

namespace waitpoint::posix {

struct AccessInstruction {
  static constexpr std::uint8_t none = 0xFF;

  std::uint64_t offset;           ///< its address in the program's file, as linked
  std::int64_t displacement;      ///< of the operand; without a register the operand's address as linked
  std::uint8_t base, index;       ///< numbers in ucontext_t's gregs; none: not in the address
  std::uint8_t scale;             ///< of the index
  std::uint8_t bytes;             ///< accessed
  bool reads, writes, is_locked;  ///< is_locked: atomic, as by the prefix `lock`
  bool is_absolute;               ///< the address is relative to where the program was loaded
};

}  // namespace waitpoint::posix
