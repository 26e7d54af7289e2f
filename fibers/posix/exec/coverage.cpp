// SPDX-License-Identifier: BSD-3-Clause
//
// What code calls from each of its basic blocks that is compiled with -fsanitize-coverage=trace-pc, or trace-pc-guard:
// they are counted, for the clock that says what they cost.
#include <cstdint>

#include "fibers/clocks/block_counter.hpp"
#include "fibers/posix/base/interposed.hpp"

WAITPOINT_INTERPOSED void __sanitizer_cov_trace_pc() { ++waitpoint::kernel::passed_blocks; }
WAITPOINT_INTERPOSED void __sanitizer_cov_trace_pc_guard(std::uint32_t*) { ++waitpoint::kernel::passed_blocks; }
WAITPOINT_INTERPOSED void __sanitizer_cov_trace_pc_guard_init(std::uint32_t*, std::uint32_t*) {}
