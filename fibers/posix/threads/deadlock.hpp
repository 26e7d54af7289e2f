// SPDX-License-Identifier: BSD-3-Clause
// What a program's threads wait for when none of them can go on.
#pragma once

#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::posix {

/// Writes it to the error stream: each thread, what it waits for and by whom that is held, with the names of the
/// program's variables where its symbols tell them.
void report_deadlock(const kernel::Scheduler& scheduler);

/// Of a thread that has just closed a cycle of those that wait for each other: whether the run goes on with the others,
/// as that of threads of the system does, which is told at once. Not where schedules are explored, nor if there is
/// nobody else. A timer of the program's may send a signal, whose handler leaves the wait: of that, nothing is told.
bool goes_on_in_cycle(kernel::Task& task);

}  // namespace waitpoint::posix
