// SPDX-License-Identifier: BSD-3-Clause
// What every room reads of the process: the record of the run, and whether it has a host. Its top, exec/ or guests/, is
// linked in one of the two, and defines has_host and refuse().
#pragma once

#include "fibers/posix/program/record.hpp"
#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {

/// Null outside `waitpoint exec`; for guests it holds settings alone.
extern Record* record;

/// Whether programs are guests in a process of somebody else's (guests.hpp), whose own code is not simulated.
extern const bool has_host;
inline bool is_host_code() { return has_host && !is_simulated(); }

/// The first task of the run, which leads to the others; not all are threads. Null outside any.
kernel::Task* first_task();

/// The thread with this gettid(); null without one.
Thread* thread_with_id(int id);

/// Ends the process for a reason of ours, told in one line.
[[noreturn]] void refuse(const char* reason);

}  // namespace waitpoint::posix
