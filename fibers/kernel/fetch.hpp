// SPDX-License-Identifier: BSD-3-Clause
// Prefetches a cache line.
#pragma once

namespace waitpoint::kernel {

/// `address` may be invalid: a prefetch does not fault. (GCC 12 drops calls of functions that only contain
/// __builtin_prefetch.)
inline void fetch(const void* address) { asm volatile("prefetcht0 (%0)" : : "r"(address)); }

}  // namespace waitpoint::kernel
