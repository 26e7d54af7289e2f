// SPDX-License-Identifier: BSD-3-Clause
// A switch of fibers in the frame of who calls a primitive, and not in one of the library's.
//
// A processor foresees where a function returns to from the calls that it has seen, and those were made by the fiber
// that is left. Where two tasks run different code, the return from the library to the one's would be foreseen to lead
// into the other's, and to find out takes as long as all the rest of a hand-over. So the library returns before the
// switch, and is called again behind it:
//
//   if (Departure away = start(...); away.leads_away()) end(depart(away), ...);
#pragma once

#include <cstdint>

#include "fibers/switch/fiber_record.hpp"

namespace waitpoint::kernel {

/// The result of a call that may block: a fiber to continue in, or the outcome of the wait.
struct Departure {
  void* context;            ///< where that fiber goes on; null without one
  std::uintptr_t how_else;  ///< the fiber that is left; or the outcome

  bool leads_away() const { return context != nullptr; }
  /// What the caller of none() meant by it.
  std::uintptr_t outcome() const { return how_else; }
  static Departure none(std::uintptr_t outcome) { return {nullptr, outcome}; }
};

/// Seen by who goes on: the fiber that was left for it, and where that one goes on.
struct Arrival {
  void* context;
  void* left;
};

// The switch: a jump to where the other fiber goes on. Were it called, the processor's stack of return addresses would
// be one too deep after each switch, and would mispredict every return from there on; this keeps it as deep as the
// fibers' own. And the compiler knows which registers are lost, and saves those alone that it still needs.
//
// What is left on the stack is what jump_fcontext of Boost.Context leaves there, which made the fiber's first such
// frame: mxcsr:4 x87 control word:4 | r12 to r15, empty here | rbx | rbp | where it goes on. Of a frame that needs rbx
// or rbp a compiler cannot be told that they are lost. Who contains this calls functions too, and so has no red zone
// below its stack.
#ifdef __x86_64__
[[gnu::always_inline]] inline Arrival depart(Departure away) {
  Arrival arrival;
  asm volatile(
      "leaq 1f(%%rip), %%rax\n\t"
      "leaq -0x40(%%rsp), %%rsp\n\t"
      "stmxcsr (%%rsp)\n\t"
      "fnstcw 4(%%rsp)\n\t"
      "movq %%rbx, 0x28(%%rsp)\n\t"
      "movq %%rbp, 0x30(%%rsp)\n\t"
      "movq %%rax, 0x38(%%rsp)\n\t"
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
      : "rcx", "rsi", "r8", "r9", "r10", "r11", "r12", "r13", "r14", "r15", "xmm0", "xmm1", "xmm2", "xmm3", "xmm4",
        "xmm5", "xmm6", "xmm7", "xmm8", "xmm9", "xmm10", "xmm11", "xmm12", "xmm13", "xmm14", "xmm15",
#ifdef __AVX512F__
        "xmm16", "xmm17", "xmm18", "xmm19", "xmm20", "xmm21", "xmm22", "xmm23", "xmm24", "xmm25", "xmm26", "xmm27",
        "xmm28", "xmm29", "xmm30", "xmm31", "k1", "k2", "k3", "k4", "k5", "k6", "k7",
#endif
        "st", "st(1)", "st(2)", "st(3)", "st(4)", "st(5)", "st(6)", "st(7)", "memory", "cc");
  arrival.left = reinterpret_cast<void*>(away.how_else);
  return arrival;
}
#else
Arrival depart(Departure away);
#endif

/// Behind a switch: who was left. Only who goes on knows where that one does.
inline Fiber& note_where_left(const Arrival& arrival) {
  Fiber& left = *static_cast<Fiber*>(arrival.left);
  left.context = arrival.context;
  return left;
}

}  // namespace waitpoint::kernel
