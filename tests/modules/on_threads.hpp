// SPDX-License-Identifier: BSD-3-Clause
// Tests for threads of either kind: their sources are built into two programs, test-modules with simulated threads, and
// test-native with WAITPOINT_REAL_THREADS defined for all its files.
#pragma once

#include <functional>

namespace waitpoint {

/// Runs `body` on the threads that the program is compiled for: on simulated ones in several orders, on real ones once.
void on_threads(const std::function<void()>& body);

}  // namespace waitpoint
