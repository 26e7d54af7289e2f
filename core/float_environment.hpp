// SPDX-License-Identifier: BSD-3-Clause
// The control bits of the floating-point environment: rounding, enabled exceptions, flushing of small numbers to zero.
// A module's code that changes them, as libraries with -ffast-math do when they are loaded, would change the results
// of all code that runs after it. The flags of exceptions that have occurred do not matter.
#pragma once

#include <cfenv>
#include <cstdint>
#include <string>

#include "core/instructions.hpp"

namespace waitpoint {

class FloatEnvironment {
 public:
  FloatEnvironment() { read(); }

  /// That of a process at its start, and of the calling thread at present.
  static bool is_standard() { return FloatEnvironment().has_standard_values(); }
  /// Gives the calling thread the standard one; returns what was different, in words, or nothing.
  static std::string restore_standard();

 private:
#if WAITPOINT_X86_64
  static constexpr std::uint32_t occurred = 0x3F, standard_vectors = 0x1F80;
  static constexpr std::uint16_t standard_stack = 0x37F;

  void read() { asm volatile("stmxcsr %0\n\tfnstcw %1" : "=m"(vectors_), "=m"(stack_)); }
  bool has_standard_values() const { return (vectors_ & ~occurred) == standard_vectors && stack_ == standard_stack; }

  std::uint32_t vectors_ = 0;
  std::uint16_t stack_ = 0;  // of the x87 instructions, which long double uses
#elif WAITPOINT_AARCH64
  void read() { asm volatile("mrs %0, fpcr" : "=r"(control_)); }
  bool has_standard_values() const { return control_ == 0; }

  std::uint64_t control_ = 0;
#else
  void read() { rounding_ = std::fegetround(); }
  bool has_standard_values() const { return rounding_ == FE_TONEAREST; }

  int rounding_ = FE_TONEAREST;
#endif
};

}  // namespace waitpoint
