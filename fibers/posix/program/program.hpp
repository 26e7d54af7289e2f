// SPDX-License-Identifier: BSD-3-Clause
// The process as all rooms see it: the record of the run, and whether there is a host. The top room, exec/ or
// in_process/, of which a library has one, defines has_host and refuse().
#pragma once

#include "fibers/posix/program/record.hpp"
#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {

/// Null outside `waitpoint exec`; in the process of a host it holds only settings.
extern Record* record;

/// True if programs are in the process of their host (in_process/layer.hpp), whose own code is not simulated.
extern const bool has_host;
inline bool is_host_code() { return has_host && !is_simulated(); }

/// The head of the run's list of tasks, not all of which are threads. Null outside a run.
kernel::Task* first_task();

/// The thread with this gettid(); null without one.
Thread* thread_with_id(int id);

/// Called, unless null, when the process is about to end with this exit status; it need not return.
extern void (*instead_of_ending)(int status);

/// Ends the process with a one-line reason.
[[noreturn]] void refuse(const char* reason);

}  // namespace waitpoint::posix
