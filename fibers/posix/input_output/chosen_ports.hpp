// SPDX-License-Identifier: BSD-3-Clause
// Ports that the system chooses for internet sockets. With a machine of its own, a run's processes have all ports for
// themselves: then they get them in the order of asking, the same in each run, where the system would draw them.
#pragma once

namespace waitpoint::posix {

/// Before a call by which the system would choose a port for the socket: gives it the next one, if it has none.
void bind_to_next_port(int descriptor);

}  // namespace waitpoint::posix
