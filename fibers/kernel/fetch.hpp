// SPDX-License-Identifier: BSD-3-Clause
// Asks the processor for a cache line that will be needed soon.
#pragma once

namespace waitpoint::kernel {

/// `address` may be any: nothing is read. (GCC 12 drops calls to a function that does nothing but __builtin_prefetch.)
inline void fetch(const void* address) { asm volatile("prefetcht0 (%0)" : : "r"(address)); }

}  // namespace waitpoint::kernel
