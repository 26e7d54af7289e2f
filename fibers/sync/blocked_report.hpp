// SPDX-License-Identifier: BSD-3-Clause
// Why nothing goes on, in words: who waits for what, who holds it, and where in the source each waits.
#pragma once

#include <string>

#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::sync {

/// Whether to say where in the source each task is: that takes a second.
enum class Places : bool { left_out, told };

/// After a run stopped for a deadlock, or went idle with tasks left: the cycle where there is one, else all that wait.
std::string describe_deadlock(kernel::Scheduler& scheduler, Places places);

/// After a run stopped for lack of progress: the tasks that spin at this instant.
std::string describe_spinning(kernel::Scheduler& scheduler, Places places);

/// After a run that had all the time there is: the tasks that sleep for ever.
std::string describe_endless(kernel::Scheduler& scheduler, Places places);

}  // namespace waitpoint::sync
