// SPDX-License-Identifier: BSD-3-Clause
// The number of basic blocks of instrumented code executed: the source of the `counted` clock.
//
// Code compiled with -fsanitize-coverage=trace-pc (g++, clang++) or trace-pc-guard (clang++) calls a function from each
// of its basic blocks: see block_calls.cpp. All tasks share one OS thread, so one counter suffices.
#pragma once

#include <cstdint>

namespace waitpoint::kernel {

/// Since the start of the process; only instrumented code increments it.
extern std::uint64_t passed_blocks;

inline std::uint64_t blocks_passed() { return passed_blocks; }

}  // namespace waitpoint::kernel
