// SPDX-License-Identifier: BSD-3-Clause
// A machine of its own for a run's processes (Settings::own_machine), as far as programs meet each other on one: a
// network whose only device is the loopback, with multicast, an empty /dev/shm, and no POSIX message queues. Nobody
// else hears what the processes send, and nothing of other runs is there.
#pragma once

namespace waitpoint::posix {

/// Called by the run's first process while it has one thread; its children inherit the machine. Ends the process with
/// a reason if the system allows none.
void enter_own_machine();

}  // namespace waitpoint::posix
