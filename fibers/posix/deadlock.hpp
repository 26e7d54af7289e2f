// SPDX-License-Identifier: BSD-3-Clause
// What a program's threads wait for when none of them can go on.
#pragma once

#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::posix {

/// Writes it to the error stream: each thread, what it waits for and by whom that is held, with the names of the
/// program's variables where its symbols tell them.
void report_deadlock(const kernel::Scheduler& scheduler);

}  // namespace waitpoint::posix
