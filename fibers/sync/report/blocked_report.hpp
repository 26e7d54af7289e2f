// SPDX-License-Identifier: BSD-3-Clause
// Reports of deadlocks and of runs without progress: each blocked task, the object it waits for, the object's owner,
// and the source location of the wait.
#pragma once

#include <string>

#include "fibers/kernel/task.hpp"

namespace waitpoint::sync {

/// Controls the source locations in a report: looking them up takes a second.
enum class Places : bool { left_out, told };

/// After a run stopped for a deadlock, or went idle with tasks left: the cycle if there is one, else all blocked tasks.
std::string describe_deadlock(kernel::Scheduler& scheduler, Places places);

/// After a run stopped for lack of progress: the tasks that spin at this instant.
std::string describe_spinning(kernel::Scheduler& scheduler, Places places);

/// After a run that reached the end of virtual time: the tasks that sleep without end.
std::string describe_endless(kernel::Scheduler& scheduler, Places places);

/// Between windows: the tasks that have waited without a timeout since `since` or longer, a line each, all beginning
/// with a line break; empty if there are none. Services count only within a codel (kernel::Work): they wait for
/// requests by their nature.
std::string describe_idle(kernel::Scheduler& scheduler, Time since, Places places);

}  // namespace waitpoint::sync
