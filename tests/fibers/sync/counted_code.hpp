// SPDX-License-Identifier: BSD-3-Clause
// Code compiled with coverage instrumentation: see tests/fibers/sync/meson.build.
#pragma once

namespace waitpoint {

/// The length of the Collatz sequence from `n` to 1.
unsigned collatz_steps(unsigned long n);

}  // namespace waitpoint
