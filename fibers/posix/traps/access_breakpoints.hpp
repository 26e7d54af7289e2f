// SPDX-License-Identifier: BSD-3-Clause
// Accesses to memory of a program that is not instrumented, as switch points: breakpoints at the instructions that a
// disassembler has found. At each the access is reported as by an instrumented program (explore/races), then a copy of
// the instruction is executed.
//
//   breakpoint (int3) --> on a stack of this layer: report, maybe other threads run --> copy of the instruction
//        ^                                                                                     |
//        +------------------------- ... the program's code <-- jump <--------------------------+
//
// The program's own stacks are not used meanwhile, as they may be small; its handlers of signals are run after the
// report, where the system would. They are set when the program makes its first thread: before, nothing is shared; in
// libraries that are loaded later, when it makes the next one.
#pragma once

#include <signal.h>
#include <ucontext.h>

#include <cstdint>
#include <span>

#include "fibers/explore/strategies/switch_points.hpp"
#include "fibers/posix/traps/access_instruction.hpp"
#include "fibers/posix/traps/report_stacks.hpp"

namespace waitpoint::posix {

/// Reports the access of `bytes` at `address` by the instruction with this `place`; other threads may run.
using ReportAccess = void (*)(std::uint64_t address, std::uint32_t bytes, bool writes, bool is_atomic,
                              std::uint64_t place);

/// The breakpoints to set; the memory of `instructions`, in the order of their places, and of `libraries` must stay.
/// `loaded` is called with a bit for each library that has breakpoints, the lowest for the first. Where a thread spins
/// (spinning.hpp) `let_others_run` is called. After `hits_of_one_max` hits of one it is removed, after `hits_max` of
/// all they all are, and `missed` is called: a long loop must end. Threads that spin have as many hits for themselves.
/// If there is an obstacle, it is told, and there are no breakpoints from then on.
struct Breakpoints {
  std::span<const AccessInstruction> instructions;
  std::span<const AccessLibrary> libraries;
  void (*loaded)(std::uint64_t libraries);
  ReportAccess report;
  std::uint64_t (*switches)();  ///< the number of switches between threads so far
  void (*let_others_run)();
  void (*missed)();
  void (*prevented)(AccessObstacle obstacle);
  std::uint32_t hits_of_one_max, hits_max, spins_max;
};
void trap_accesses(const Breakpoints& breakpoints);
/// Zeroed memory for stacks and tables of all later runs, in place of memory that each maps: `for_breakpoints` bytes.
void keep_memory_for_breakpoints(void* memory, std::size_t bytes);
inline constexpr std::size_t for_breakpoints = ReportStacks::bytes + (std::size_t{1} << 26);
bool are_accesses_trapped();
/// The program has done what breakpoints would disturb: they are removed.
void prevent_breakpoints(AccessObstacle obstacle);
/// The same if this changes the protection of code with breakpoints.
void prevent_breakpoints_in(const void* begin, std::size_t bytes);
/// Takes all breakpoints away, before the process is put back to a state without them.
void restore_code();

/// In a handler of SIGTRAP: true if it came from a breakpoint, which is dealt with; may leave the handler instead.
bool answer_access(siginfo_t* information, ucontext_t* context);
/// In any handler: where a copy was interrupted, the context is that of the program's own code from now on.
void leave_copies(ucontext_t* context);
/// True if the handler runs on the system's alternate stack, which is this layer's while accesses are trapped.
bool is_on_stack_of_traps(const ucontext_t* context);
/// The program has set its alternate stack: this layer's is set again.
void keep_stack_of_traps();

}  // namespace waitpoint::posix
