// SPDX-License-Identifier: BSD-3-Clause
// Accesses to memory of a program that is not instrumented, as switch points: breakpoints at the instructions that a
// disassembler has found. At each the access is reported as by an instrumented program (explore/races), then the
// instruction is executed in a single step.
//
//   breakpoint (int3) --> report, maybe other threads run --> original byte, trap flag --> instruction
//        ^                                                                                     |
//        +------------------------------- int3 again, no trap flag <-- trap ------------------+
//
// All threads run in one thread of the system, so none executes the instruction while its breakpoint is away. They are
// set when the program makes its first thread: before, nothing is shared.
#pragma once

#include <cstdint>
#include <span>

#include "fibers/posix/traps/access_instruction.hpp"

namespace waitpoint::posix {

/// Reports the access of `bytes` at `address` by the instruction with the offset `place`; other threads may run.
using ReportAccess = void (*)(std::uint64_t address, std::uint32_t bytes, bool writes, bool is_atomic,
                              std::uint64_t place);

/// The breakpoints to set; the memory of `instructions`, in the order of their offsets, must stay. At each thousandth
/// hit of one breakpoint `let_others_run` is called: it may be in a loop that waits for another thread. After
/// `hits_of_one_max` hits of one, or `hits_max` of all, they are removed, and `missed` is called: a long loop must end.
struct Breakpoints {
  std::span<const AccessInstruction> instructions;
  ReportAccess report;
  void (*let_others_run)();
  void (*missed)();
  std::uint32_t hits_of_one_max, hits_max;
};
void trap_accesses(const Breakpoints& breakpoints);
bool are_accesses_trapped();
/// Takes all breakpoints away, before the process is put back to a state without them.
void restore_code();

/// In a handler of SIGTRAP: true if it came from a breakpoint, which is dealt with.
bool answer_access(void* context);

}  // namespace waitpoint::posix
