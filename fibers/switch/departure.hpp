// SPDX-License-Identifier: BSD-3-Clause
// A switch of fibers in the frame of a primitive's caller, not in a frame of the library.
//
// The return predictor holds the other task's calls: after a switch inside the library, the return to the caller would
// be mispredicted if the two tasks run different code. A misprediction costs as much as the rest of a hand-over. So the
// library returns before the switch and is called again after it:
//
//   if (Departure away = start(...); away.leads_away()) end(depart(away), ...);
#pragma once

#include <cstdint>

#include "core/instructions.hpp"
#include "fibers/switch/fiber_record.hpp"

namespace waitpoint::kernel {

/// The result of a call that may block: a fiber to continue in, or the outcome of the wait.
struct Departure {
  void* context;            ///< the context of the fiber to enter; null: none
  std::uintptr_t how_else;  ///< the fiber that is left; without a context, the outcome

  bool leads_away() const { return context != nullptr; }
  /// The argument of none().
  std::uintptr_t outcome() const { return how_else; }
  static Departure none(std::uintptr_t outcome) { return {nullptr, outcome}; }
};

/// The result of depart() in the entered fiber: the fiber that was left, and its context.
struct Arrival {
  void* context;
  void* left;
};

// The switch: a jump to the other fiber's address of continuation. A call would leave the return stack buffer one entry
// too deep after each switch, and mispredict all later returns; a jump keeps its depth equal to the fibers'. Inline
// assembly tells the compiler the clobbered registers, so that it saves only those it still needs.
//
// The frame on the stack, also a fiber's first one (fiber.cpp): mxcsr:4 x87 control word:4 | four words that are not
// used | rbx | rbp | address of continuation. rbx and rbp are saved here, since a compiler does not accept them as
// clobbers in a frame that needs them. Functions that contain this call others too, so they have no red zone below
// their stack.
//
// On other processors, and in portable builds, it is jump_fcontext itself.
#if WAITPOINT_X86_64
/// Pushes the frame that depart() restores, whose continuation is the label 1.
#define WAITPOINT_PUSH_FRAME     \
  "leaq 1f(%%rip), %%rax\n\t"    \
  "leaq -0x40(%%rsp), %%rsp\n\t" \
  "stmxcsr (%%rsp)\n\t"          \
  "fnstcw 4(%%rsp)\n\t"          \
  "movq %%rbx, 0x28(%%rsp)\n\t"  \
  "movq %%rbp, 0x30(%%rsp)\n\t"  \
  "movq %%rax, 0x38(%%rsp)\n\t"

[[gnu::always_inline]] inline Arrival depart(Departure away) {
  Arrival arrival;
  asm volatile(WAITPOINT_PUSH_FRAME
               "movq %%rsp, %%rax\n\t"
               "movq %%rdi, %%rsp\n\t"
               "ldmxcsr (%%rsp)\n\t"
               "fldcw 4(%%rsp)\n\t"
               "movq 0x28(%%rsp), %%rbx\n\t"
               "movq 0x30(%%rsp), %%rbp\n\t"
               "movq 0x38(%%rsp), %%r8\n\t"
               "leaq 0x40(%%rsp), %%rsp\n\t"
               "jmp *%%r8\n"
               "1:"
               : "=a"(arrival.context), "+d"(away.how_else), "+D"(away.context)
               :
               : "rcx", "rsi", "r8", "r9", "r10", "r11", "r12", "r13", "r14", "r15", "xmm0", "xmm1", "xmm2", "xmm3",
                 "xmm4", "xmm5", "xmm6", "xmm7", "xmm8", "xmm9", "xmm10", "xmm11", "xmm12", "xmm13", "xmm14", "xmm15",
#ifdef __AVX512F__
                 "xmm16", "xmm17", "xmm18", "xmm19", "xmm20", "xmm21", "xmm22", "xmm23", "xmm24", "xmm25", "xmm26",
                 "xmm27", "xmm28", "xmm29", "xmm30", "xmm31", "k1", "k2", "k3", "k4", "k5", "k6", "k7",
#endif
                 "st", "st(1)", "st(2)", "st(3)", "st(4)", "st(5)", "st(6)", "st(7)", "memory", "cc");
  arrival.left = reinterpret_cast<void*>(away.how_else);
  return arrival;
}
#else
Arrival depart(Departure away);
#endif

/// After a switch: stores the context of the fiber that was left, which only the entered fiber knows, and returns that
/// fiber.
inline Fiber& note_where_left(const Arrival& arrival) {
  Fiber& left = *static_cast<Fiber*>(arrival.left);
  left.context = arrival.context;
  return left;
}

}  // namespace waitpoint::kernel
