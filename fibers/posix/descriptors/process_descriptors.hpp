// SPDX-License-Identifier: BSD-3-Clause
// Descriptors of processes (pidfd_open()). They are the system's; operations on a descriptor of this process are
// simulated.
#pragma once

#include <sys/types.h>

namespace waitpoint::posix {

/// The process of a descriptor; -1 if it is no process descriptor, or the process has been reaped.
pid_t process_of(int descriptor);

}  // namespace waitpoint::posix
