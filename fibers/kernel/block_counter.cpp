// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/block_counter.hpp"

namespace {
std::uint64_t passed = 0;
}  // namespace

namespace waitpoint::kernel {

std::uint64_t blocks_passed() { return passed; }

}  // namespace waitpoint::kernel

// Never instrumented itself: it would call itself.
#ifdef __clang__
#define WAITPOINT_NOT_COUNTED __attribute__((no_sanitize("coverage")))
#else
#define WAITPOINT_NOT_COUNTED __attribute__((no_sanitize_coverage))
#endif

// Weak: a fuzzer's runtime that is linked in has the last word.
extern "C" {
__attribute__((weak)) WAITPOINT_NOT_COUNTED void __sanitizer_cov_trace_pc() { ++passed; }
__attribute__((weak)) WAITPOINT_NOT_COUNTED void __sanitizer_cov_trace_pc_guard(std::uint32_t*) { ++passed; }
__attribute__((weak)) WAITPOINT_NOT_COUNTED void __sanitizer_cov_trace_pc_guard_init(std::uint32_t*, std::uint32_t*) {}
}
