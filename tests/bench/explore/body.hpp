// SPDX-License-Identifier: BSD-3-Clause
// The body whose schedules are counted, compiled once as it is and once with its accesses to memory instrumented.
#pragma once

namespace waitpoint::bench {

/// Four threads that take a mutex in turn: about a hundred switch points.
void contend();

}  // namespace waitpoint::bench
