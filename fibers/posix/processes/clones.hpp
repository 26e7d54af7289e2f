// SPDX-License-Identifier: BSD-3-Clause
// Processes and threads that a program makes and ends as the C library does: by clone() or the system calls.
//
// A clone without shared memory is forked. A clone that shares memory but is a process of its own is not simulated, as
// it has no memory for a simulation: its maker waits until it has ended or executes another program. A clone in the
// same process is a thread of the simulation, with a stack and thread-local storage of the layer's.
#pragma once

namespace waitpoint::posix {

struct CallWords;

/// SYS_clone, SYS_clone3, SYS_exit and SYS_set_tid_address, of a simulated thread. As the system calls, but clones that
/// return from the call on another stack fail with ENOSYS.
long call_about_clones(long number, const CallWords& words);

}  // namespace waitpoint::posix
