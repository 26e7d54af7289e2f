// SPDX-License-Identifier: BSD-3-Clause
// While a program has native children, or partners outside (partners.hpp), its virtual time is no faster than real
// time, or than a multiple of it (--speed): processes that wait for each other by sleeping or with timeouts have no
// other time in common.
//
// Otherwise virtual time does not wait. Input that arrives while it waits is dated by the virtual time reached.
#pragma once

#include <sys/types.h>

#include "fibers/kernel/task.hpp"

namespace waitpoint::posix {

/// The running thread has made a child that is not simulated; its number is the system's.
void note_native_child(pid_t child);
/// In a child of its own: those are its parent's.
void forget_native_children();

/// The running thread is about to wait for a partner outside.
void prepare_to_keep_pace();

/// Between windows of the run: true if virtual time must wait for real time.
bool is_paced(const kernel::Scheduler& scheduler);
/// The real time left until the virtual time `time`; zero if it is past.
Duration left_until(Time time);
/// Schedules an event that checks for input from outside, at the virtual time of the present real time, and returns
/// that time; if it is not before `next`, returns `next`.
Time look_at_pace(kernel::Scheduler& scheduler, Time next);

/// Between windows: says so, once, if virtual time is far ahead of real time while a thread waits for a terminal or a
/// standard input from outside.
void report_if_ahead(const kernel::Scheduler& scheduler);

}  // namespace waitpoint::posix
