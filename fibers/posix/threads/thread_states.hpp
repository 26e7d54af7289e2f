// SPDX-License-Identifier: BSD-3-Clause
// What threads do, in words: for what they wait, and who holds it. Objects have the names of the program's variables,
// if it has symbols.
#pragma once

#include "fibers/kernel/task.hpp"
#include "fibers/posix/base/bounded_text.hpp"

namespace waitpoint::posix {

/// "12.000000000 s of virtual time".
void add_time(BoundedText& text, Time time);
/// A line: "  main waits for mutex jobs_lock, held by thread 1", with the program's name if there are several.
void add_state(BoundedText& text, const kernel::Task& task);
/// A line for each thread of the run.
void add_states(BoundedText& text, const kernel::Scheduler& scheduler);

}  // namespace waitpoint::posix
