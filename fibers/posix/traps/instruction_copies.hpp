// SPDX-License-Identifier: BSD-3-Clause
// Copies of a module's instructions, each followed by a jump back to behind the original: where that is replaced by a
// breakpoint, the copy is executed.
#pragma once

#include <cstdint>
#include <span>

#include "fibers/posix/traps/access_instruction.hpp"
#include "fibers/posix/traps/library_range.hpp"

namespace waitpoint::posix {

/// Zeroed memory that can be executed, near the program, for the copies of all later runs; empty without memory.
LibraryRange reserve_for_copies();
/// The same, after that.
LibraryRange reserved_for_copies();

class InstructionCopies {
 public:
  /// Of a module that is loaded at this address; false without memory that its code can reach.
  bool make(std::span<const AccessInstruction> instructions, std::uint64_t loaded_at);
  void remove();

  /// The address of the copy of an instruction, by its number.
  std::uint64_t of(std::size_t instruction) const { return begin_ + instruction * copy_bytes; }
  /// For a place within the copies, that in the module's code where execution is; any other remains.
  std::uint64_t original_of(std::uint64_t place) const;

 private:
  static constexpr std::uint64_t copy_bytes = 32;

  std::span<const AccessInstruction> instructions_;
  std::uint64_t loaded_at_ = 0, begin_ = 0, end_ = 0;
};

}  // namespace waitpoint::posix
