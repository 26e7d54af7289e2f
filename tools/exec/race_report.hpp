// SPDX-License-Identifier: BSD-3-Clause
// A text report of the data races of a program's run.
#pragma once

#include <string>

#include "fibers/posix/program/record.hpp"

namespace waitpoint::tools {

/// Several lines for each: two accesses and their source locations. Empty without races.
std::string races_of(const posix::Record& record);

}  // namespace waitpoint::tools
