// SPDX-License-Identifier: BSD-3-Clause
// The thread pointer: the base of thread-local storage (x86-64's FS base). A fiber with one of its own has its own copy
// of all per-thread state of a C library: errno, locale, exceptions in flight, keys.
#pragma once

#include "core/error.hpp"
#include "core/instructions.hpp"
#if WAITPOINT_X86_64
#include <asm/prctl.h>
#include <sys/auxv.h>
#include <sys/syscall.h>
#endif

namespace waitpoint::kernel {

#if WAITPOINT_X86_64

inline void* thread_pointer() {
  void* pointer = nullptr;
  asm("movq %%fs:0, %0" : "=r"(pointer));
  return pointer;
}

/// True if wrfsbase may be used: Linux 5.9 and a processor with it (HWCAP2_FSGSBASE).
inline const bool writes_thread_pointer = (getauxval(AT_HWCAP2) & 2) != 0;

inline void set_thread_pointer(void* pointer) {
  if (__builtin_expect(writes_thread_pointer, 1)) {
    asm volatile("wrfsbase %0" : : "r"(pointer) : "memory");
    return;
  }
  // Not by the C library's function, which might set errno of the wrong thread.
  long result = SYS_arch_prctl;
  asm volatile("syscall" : "+a"(result) : "D"(static_cast<long>(ARCH_SET_FS)), "S"(pointer) : "rcx", "r11", "memory");
}

#else

inline void* thread_pointer() { return nullptr; }
inline void set_thread_pointer(void*) { WAITPOINT_CHECK(false, "threads of programs are simulated on x86-64 only"); }

#endif

}  // namespace waitpoint::kernel
