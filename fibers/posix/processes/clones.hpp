// SPDX-License-Identifier: BSD-3-Clause
// Processes and threads that a program makes and ends as the C library does it: by clone(), or by its number.
//
// What shares no memory with its maker is forked. What shares it and is a process of its own runs with nothing of it
// simulated, as it has no memory for a simulation: its maker waits until it has ended or become another program. What
// belongs to the same process is a thread of the simulation, with a stack and thread-local storage of the layer's.
#pragma once

namespace waitpoint::posix {

struct CallWords;

/// SYS_clone, SYS_clone3, SYS_exit and SYS_set_tid_address, of a simulated thread. As the system's calls, but what is
/// to go on behind the call on another stack is refused with ENOSYS.
long call_about_clones(long number, const CallWords& words);

}  // namespace waitpoint::posix
