// SPDX-License-Identifier: BSD-3-Clause
// Prefetches a cache line.
#pragma once

#include "core/instructions.hpp"

namespace waitpoint::kernel {

/// `address` may be invalid: a prefetch does not fault. (GCC 12 drops calls of functions that only contain
/// __builtin_prefetch.)
inline void fetch(const void* address) {
#if WAITPOINT_X86_64
  asm volatile("prefetcht0 (%0)" : : "r"(address));
#elif WAITPOINT_AARCH64
  asm volatile("prfm pldl1keep, [%0]" : : "r"(address));
#else
  __builtin_prefetch(address);
#endif
}

}  // namespace waitpoint::kernel
