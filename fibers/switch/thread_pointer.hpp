// SPDX-License-Identifier: BSD-3-Clause
// The thread pointer: where the code of a process finds its thread-local variables (x86-64's FS base). A fiber that has
// one of its own has all of a thread that a C library keeps there: errno, locale, exceptions in flight, keys.
#pragma once

#if defined(__x86_64__)
#include <asm/prctl.h>
#include <sys/auxv.h>
#include <sys/syscall.h>
#endif

#include "core/error.hpp"

namespace waitpoint::kernel {

/// Whether fibers can have one here.
constexpr bool has_thread_pointers() {
#if defined(__x86_64__)
  return true;
#else
  return false;
#endif
}

#if defined(__x86_64__)

inline void* thread_pointer() {
  void* pointer = nullptr;
  asm("movq %%fs:0, %0" : "=r"(pointer));
  return pointer;
}

/// Whether the instruction may be used: Linux 5.9 and a processor that has it (HWCAP2_FSGSBASE).
inline const bool writes_thread_pointer = (getauxval(AT_HWCAP2) & 2) != 0;

inline void set_thread_pointer(void* pointer) {
  if (__builtin_expect(writes_thread_pointer, 1)) {
    asm volatile("wrfsbase %0" : : "r"(pointer) : "memory");
    return;
  }
  // As a call of the C library it might set errno, in the wrong thread.
  long result = SYS_arch_prctl;
  asm volatile("syscall" : "+a"(result) : "D"(static_cast<long>(ARCH_SET_FS)), "S"(pointer) : "rcx", "r11", "memory");
}

#else

inline void* thread_pointer() { return nullptr; }
inline void set_thread_pointer(void*) { WAITPOINT_CHECK(false, "threads of programs are simulated on x86-64 only"); }

#endif

}  // namespace waitpoint::kernel
