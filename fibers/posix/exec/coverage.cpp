// SPDX-License-Identifier: BSD-3-Clause
//
// Called from each basic block of code compiled with -fsanitize-coverage=trace-pc or trace-pc-guard: the blocks are
// counted for the clock `counted`.
#include <cstdint>

#include "fibers/clocks/block_counter.hpp"
#include "fibers/posix/base/interposed.hpp"

WAITPOINT_INTERPOSED void __sanitizer_cov_trace_pc() { ++waitpoint::kernel::passed_blocks; }
WAITPOINT_INTERPOSED void __sanitizer_cov_trace_pc_guard(std::uint32_t*) { ++waitpoint::kernel::passed_blocks; }
WAITPOINT_INTERPOSED void __sanitizer_cov_trace_pc_guard_init(std::uint32_t*, std::uint32_t*) {}
