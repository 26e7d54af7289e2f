// SPDX-License-Identifier: BSD-3-Clause
// Call stacks of the program's code, for reports: without the layer's own frames.
#pragma once

#include <span>

#include "fibers/kernel/task.hpp"
#include "fibers/sync/report/source_lines.hpp"

namespace waitpoint::posix {

/// Of these return addresses, innermost first.
sync::CodePlaces program_calls(std::span<void* const> frames);
/// Of the running thread, from within a call of the layer or a handler.
sync::CodePlaces running_calls();
/// Of a task that does not run, from outside of tasks.
sync::CodePlaces program_calls(kernel::Task& task);

}  // namespace waitpoint::posix
