// SPDX-License-Identifier: BSD-3-Clause
// The call stacks of a failed run's threads, in words.
#pragma once

#include <string>

#include "fibers/posix/program/record.hpp"

namespace waitpoint::tools {

/// Each thread that no event could wake, or that crashed, with its calls in lines below; empty if there is none.
std::string last_calls_of(const posix::Record& record);

}  // namespace waitpoint::tools
