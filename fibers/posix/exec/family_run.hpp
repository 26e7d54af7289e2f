// SPDX-License-Identifier: BSD-3-Clause
// The run of a process that is not alone in its family: it takes turns with the others.
#pragma once

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::posix {

inline constexpr Duration nanosecond = Duration(std::chrono::nanoseconds(1));
/// The real time in which all data between sockets of this machine arrives, however busy it is.
inline constexpr Duration time_under_way = Duration(std::chrono::milliseconds(50));

/// The end of processes that outlive the first one: Time::max() while it lives. What comes from outside is later.
Time end_of_left_over();

/// Between two windows of the run: hands over the turn if another process is due, and waits in real time for something
/// outside if none is. Sets the end of the next window. False if the run is over: no process can continue.
bool step_in_family(kernel::Scheduler& scheduler, Time& until);

}  // namespace waitpoint::posix
