// SPDX-License-Identifier: BSD-3-Clause
// Runs of a program by fork, from where it is about to enter its main(): loading it is done once.
//
// Who explores asks over a socket, one packet a run, with four descriptors in it: the run's record, where its input
// comes from and where its output goes, and a socket on which the server answers the run's process id, and at its end
// how it ended, as waitpid() gives it. A run whose answers nobody waits for any more is killed. What a run has started
// ends with it, if it is of its process group.
#pragma once

#include <sys/types.h>

namespace waitpoint::posix {

/// The descriptors of a packet, in their order.
enum ServerDescriptor : int { run_record, run_input, run_output, run_answers, run_descriptors };

/// Sent over the server's own socket, before it is asked.
struct ServerReady {};

struct RunStarted {
  pid_t process;
};
struct RunEnded {
  int status;
};

/// Serves until nobody asks any more, and ends the process then. Returns in each run, in a process of its own, with the
/// descriptor of its record.
int serve_runs(int socket);

}  // namespace waitpoint::posix
