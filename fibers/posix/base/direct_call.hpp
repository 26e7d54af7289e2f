// SPDX-License-Identifier: BSD-3-Clause
// System calls that are not trapped: neither by filters for the C library's code, nor as instructions outside of it.
#pragma once

#include "core/instructions.hpp"
#if !WAITPOINT_X86_64
#include <unistd.h>

#include <cerrno>
#endif

namespace waitpoint::posix {

/// Read by the system at each system call outside of the C library, once raw_calls.hpp has told it so.
enum class RawCalls : unsigned char { pass = 0, are_trapped = 1 };
inline constinit RawCalls raw_calls = RawCalls::pass;

/// Returns as the system call: errors are negative, and errno stays as it is. By the C library where nothing is
/// trapped: in builds without `waitpoint exec`.
inline long call_directly(long number, long first = 0, long second = 0, long third = 0, long fourth = 0, long fifth = 0,
                          long sixth = 0) {
#if WAITPOINT_X86_64
  long result = number;
  const RawCalls before = raw_calls;
  raw_calls = RawCalls::pass;
  register long in_r10 __asm__("r10") = fourth;
  register long in_r8 __asm__("r8") = fifth;
  register long in_r9 __asm__("r9") = sixth;
  __asm__ volatile("syscall"
                   : "+a"(result)
                   : "D"(first), "S"(second), "d"(third), "r"(in_r10), "r"(in_r8), "r"(in_r9)
                   : "rcx", "r11", "memory");
  raw_calls = before;
  return result;
#else
  const int before = errno;
  const long result = syscall(number, first, second, third, fourth, fifth, sixth);
  const long outcome = result == -1 ? -errno : result;
  errno = before;
  return outcome;
#endif
}

}  // namespace waitpoint::posix
