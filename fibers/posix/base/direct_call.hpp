// SPDX-License-Identifier: BSD-3-Clause
// System calls that no filter for the C library's code traps.
#pragma once

namespace waitpoint::posix {

/// Returns as the system call: errors are negative, and errno stays as it is.
inline long call_directly(long number, long first = 0, long second = 0, long third = 0, long fourth = 0, long fifth = 0,
                          long sixth = 0) {
  long result = number;
  register long in_r10 __asm__("r10") = fourth;
  register long in_r8 __asm__("r8") = fifth;
  register long in_r9 __asm__("r9") = sixth;
  __asm__ volatile("syscall"
                   : "+a"(result)
                   : "D"(first), "S"(second), "d"(third), "r"(in_r10), "r"(in_r8), "r"(in_r9)
                   : "rcx", "r11", "memory");
  return result;
}

}  // namespace waitpoint::posix
