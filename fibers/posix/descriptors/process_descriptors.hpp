// SPDX-License-Identifier: BSD-3-Clause
// Descriptors that stand for processes (pidfd_open()). They are the system's; what is done by one that stands for this
// process is simulated.
#pragma once

#include <sys/types.h>

namespace waitpoint::posix {

/// The process that a descriptor stands for; -1 if it stands for none, or for one that is no more.
pid_t process_of(int descriptor);

}  // namespace waitpoint::posix
