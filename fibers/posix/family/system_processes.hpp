// SPDX-License-Identifier: BSD-3-Clause
// Processes as the system knows them, by its own numbers.
#pragma once

#include <sys/types.h>

namespace waitpoint::posix::family {

/// The calling process.
pid_t system_id();
/// True if the process has not ended; a zombie has.
bool is_running(pid_t system_id);
/// The status of a zombie, as waitpid() reports it; without one, that of a process that was killed.
int status_of_zombie(pid_t system_id);

}  // namespace waitpoint::posix::family
