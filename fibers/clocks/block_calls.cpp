// SPDX-License-Identifier: BSD-3-Clause
//
// What instrumented code calls from its basic blocks. A file of its own: who brings other functions of these names
// along has nothing of it linked in.
#include "fibers/clocks/block_counter.hpp"

using waitpoint::kernel::passed_blocks;

// Never instrumented itself: it would call itself.
#ifdef __clang__
#define WAITPOINT_NOT_COUNTED __attribute__((no_sanitize("coverage")))
#else
#define WAITPOINT_NOT_COUNTED __attribute__((no_sanitize_coverage))
#endif

// Weak: a fuzzer's runtime that is linked in has the last word.
extern "C" {
__attribute__((weak)) WAITPOINT_NOT_COUNTED void __sanitizer_cov_trace_pc() { ++passed_blocks; }
__attribute__((weak)) WAITPOINT_NOT_COUNTED void __sanitizer_cov_trace_pc_guard(std::uint32_t*) { ++passed_blocks; }
__attribute__((weak)) WAITPOINT_NOT_COUNTED void __sanitizer_cov_trace_pc_guard_init(std::uint32_t*, std::uint32_t*) {}
}
