// SPDX-License-Identifier: BSD-3-Clause
// An instruction of a program or one of its libraries that accesses memory, as its operand says: found by a
// disassembler in the explorer's process, trapped in the program (access_breakpoints.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

namespace waitpoint::posix {

/// A library whose instructions these are, by its file.
struct AccessLibrary {
  std::uint64_t device, inode;
};

struct AccessInstruction {
  static constexpr std::uint8_t none = 0xFF;
  static constexpr std::size_t length_max = 15;
  static constexpr unsigned module_shift = 48;

  /// The same in each run: the number of its module, 0 for the program, from 1 on for the libraries; and behind it, the
  /// address in that file, as linked.
  std::uint64_t place;
  std::int64_t displacement;      ///< of the operand; without a register the operand's address as linked
  std::uint8_t base, index;       ///< numbers in ucontext_t's gregs; none: not in the address
  std::uint8_t scale;             ///< of the index
  std::uint8_t bit;               ///< the register with the number of a bit, whose word is accessed; none: no such
  std::uint8_t bytes;             ///< accessed
  bool reads, writes, is_locked;  ///< is_locked: atomic, as by the prefix `lock`
  bool is_absolute;               ///< the address is relative to where the module was loaded
  bool is_repeated;               ///< a string instruction, for as many elements as rcx says
  bool copies;                    ///< a string instruction that also reads as many bytes at rsi
  std::uint8_t displacement_at;   ///< is_absolute: where in the code 32 bits are relative to the next instruction
  std::uint8_t length;            ///< of the code
  std::uint8_t code[length_max];

  std::size_t module() const { return place >> module_shift; }
  std::uint64_t offset() const { return place & ((std::uint64_t{1} << module_shift) - 1); }
};

}  // namespace waitpoint::posix
