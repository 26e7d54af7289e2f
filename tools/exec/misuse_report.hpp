// SPDX-License-Identifier: BSD-3-Clause
// The misuses of primitives and threads in a program's run.
#pragma once

#include <string>

#include "fibers/posix/program/record.hpp"

namespace waitpoint::tools {

/// "main unlocks mutex m, locked by thread 1": the first; empty without one.
std::string first_misuse(const posix::Record& record);
/// "misuse at 1.000000000 s: main unlocks mutex m, locked by thread 1" and the call's places in the source, for each.
std::string misuses_of(const posix::Record& record);

}  // namespace waitpoint::tools
