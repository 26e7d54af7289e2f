// SPDX-License-Identifier: BSD-3-Clause
// Random programs, by number.
#pragma once

#include <cstdint>

#include "tests/fibers/explore/completeness/program.hpp"

namespace waitpoint::completeness {

/// The `number`-th program, of two to four threads with at most eight instructions each. Each uses a few kinds of
/// primitives, often one object of each, so that the threads meet; most of them use their primitives correctly. Every
/// other one is small enough for all its schedules. With calls, a semaphore's units are read, too.
Program make_program(std::uint64_t number, bool has_calls = false);

}  // namespace waitpoint::completeness
