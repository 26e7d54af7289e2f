// SPDX-License-Identifier: BSD-3-Clause
// An assertion of a body that is explored.
#pragma once

namespace waitpoint {

/// Within a task: fails the run here if `holds` is false.
void check(bool holds, const char* message = "a check failed", const char* file = __builtin_FILE(),
           int line = __builtin_LINE());

}  // namespace waitpoint
