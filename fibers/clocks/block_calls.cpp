// SPDX-License-Identifier: BSD-3-Clause
// The functions that instrumented code calls from its basic blocks. In a file of its own, so that a program which
// defines functions of these names links nothing from here.
//
// Code compiled with -fsanitize-coverage=trace-pc (g++, clang++) or trace-pc-guard (clang++) calls one from each of its
// basic blocks: the source of the `counted` clock.
#include "fibers/kernel/turn.hpp"

using waitpoint::kernel::turn;

// Never instrumented itself: it would recurse.
#ifdef __clang__
#define WAITPOINT_NOT_COUNTED __attribute__((no_sanitize("coverage")))
#else
#define WAITPOINT_NOT_COUNTED __attribute__((no_sanitize_coverage))
#endif

// Weak: a linked fuzzer's runtime takes precedence.
extern "C" {
__attribute__((weak)) WAITPOINT_NOT_COUNTED void __sanitizer_cov_trace_pc() { ++turn.blocks; }
__attribute__((weak)) WAITPOINT_NOT_COUNTED void __sanitizer_cov_trace_pc_guard(std::uint32_t*) { ++turn.blocks; }
__attribute__((weak)) WAITPOINT_NOT_COUNTED void __sanitizer_cov_trace_pc_guard_init(std::uint32_t*, std::uint32_t*) {}
}
