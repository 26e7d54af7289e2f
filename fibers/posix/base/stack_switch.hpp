// SPDX-License-Identifier: BSD-3-Clause
// Calls a function on another stack: one that the program provided for a thread or for signal handlers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace waitpoint::posix {

/// Calls `function(argument)` with its frames at the high end of these bytes; returns to the present stack.
inline void call_on(void* low, std::size_t size, void (*function)(void*), void* argument) {
  char* top = static_cast<char*>(low) + size;
  top -= reinterpret_cast<std::uintptr_t>(top) % 16;
  // With the frame's address as an operand, the compiler keeps a frame pointer: the other stack can be unwound to this
  // one, as by pthread_exit() in a handler.
  asm volatile(
      "movq %%rsp, %%rbx\n\t"
      "movq %[top], %%rsp\n\t"
      "callq *%[function]\n\t"
      "movq %%rbx, %%rsp"
      : "+D"(argument)
      : [top] "r"(top), [function] "r"(function), "r"(__builtin_frame_address(0))
      : "rax", "rbx", "rcx", "rdx", "rsi", "r8", "r9", "r10", "r11", "memory", "cc", "xmm0", "xmm1", "xmm2", "xmm3",
        "xmm4", "xmm5", "xmm6", "xmm7", "xmm8", "xmm9", "xmm10", "xmm11", "xmm12", "xmm13", "xmm14", "xmm15");
}

}  // namespace waitpoint::posix
