// SPDX-License-Identifier: BSD-3-Clause
// While a program has children, or is one of another's, its virtual time goes no faster than the real one: processes
// that wait for each other by sleeping for a while have only that in common.
//
// Otherwise virtual time does not wait for anything. What comes from outside while it waits comes at the virtual time
// that it has waited for.
#pragma once

#include <sys/types.h>

#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::posix {

/// The running thread has made a child.
void note_child(pid_t child);
/// This is a new child, or a program that another simulation has started.
void note_parent();

/// Whether virtual time has to wait.
bool is_paced();
/// The real time that is left until `time` may come, at least a nanosecond; none if it may now.
Duration left_until(Time time);
/// What has come from outside is looked at by an event at the virtual time that is now, if that is before `next`; it is
/// due before what is returned.
Time look_at_pace(kernel::Scheduler& scheduler, Time next);

}  // namespace waitpoint::posix
