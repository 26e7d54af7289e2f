// SPDX-License-Identifier: BSD-3-Clause
// The data races of a program's run, in words.
#pragma once

#include <string>

#include "fibers/posix/program/record.hpp"

namespace waitpoint::tools {

/// Some lines for each: two accesses, and where in the source they are. Nothing where none was found.
std::string races_of(const posix::Record& record);

}  // namespace waitpoint::tools
