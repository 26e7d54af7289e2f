// SPDX-License-Identifier: BSD-3-Clause
// The explored body, compiled once plainly and once with its accesses to memory instrumented.
#pragma once

namespace waitpoint::bench {

/// Four threads that contend for a mutex: about a hundred switch points.
void contend();

}  // namespace waitpoint::bench
