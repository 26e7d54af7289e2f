// SPDX-License-Identifier: BSD-3-Clause
// Code that is compiled with coverage instrumentation: see tests/meson.build.
#pragma once

namespace waitpoint {

/// How many steps `n` takes to come to 1: three times it and one, or the half of it.
unsigned collatz_steps(unsigned long n);

}  // namespace waitpoint
