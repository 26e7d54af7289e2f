// SPDX-License-Identifier: BSD-3-Clause
// The part of a death's report that needs the heap: see kernel/fault_reports.hpp.
#pragma once

namespace waitpoint::sync {

/// Writes the caller's call stack to the error stream, as "  function at file:line", innermost first: only the user's
/// frames, as in reports of deadlocks. A post mortem; `reason` is not repeated.
void write_call_stack(const char* reason);

}  // namespace waitpoint::sync
