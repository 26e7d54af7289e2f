// SPDX-License-Identifier: BSD-3-Clause
// How many basic blocks of instrumented code were passed: the source of the `counted` clock.
//
// Code compiled with -fsanitize-coverage=trace-pc (g++, clang++) or trace-pc-guard (clang++) calls here from each of
// its basic blocks. All tasks share one OS thread, so one counter does.
#pragma once

#include <cstdint>

namespace waitpoint::kernel {

/// Since the program began.
std::uint64_t blocks_passed();

}  // namespace waitpoint::kernel
