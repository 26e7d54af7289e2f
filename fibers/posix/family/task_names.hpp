// SPDX-License-Identifier: BSD-3-Clause
// Tasks as reports name them.
#pragma once

#include "fibers/kernel/task.hpp"
#include "fibers/posix/base/bounded_text.hpp"

namespace waitpoint::posix {

/// "main", or "reader: main" if there are several programs.
void add_name(BoundedText& text, const kernel::Task& task);

}  // namespace waitpoint::posix
