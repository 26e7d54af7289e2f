// SPDX-License-Identifier: BSD-3-Clause
// Runs of a program by fork, from the point before main(): the program is loaded only once.
//
// The explorer requests each run by a packet over a socket, with four descriptors in it: the run's record, its input,
// its output, and a socket for the answers: first the run's process id, at its end its status, as of waitpid(). A run
// is killed when the other end of its answers is closed. Processes of a run's group end with it.
#pragma once

#include <sys/types.h>

namespace waitpoint::posix {

/// The descriptors of a packet, in their order.
enum ServerDescriptor : int { run_record, run_input, run_output, run_answers, run_descriptors };

/// Sent over the server's own socket, before the first request.
struct ServerReady {};

struct RunStarted {
  pid_t process;
};
struct RunEnded {
  int status;
};

/// Serves until the other end of the socket is closed, then ends the process. Returns in each run, in a process of its
/// own, with the descriptor of its record.
int serve_runs(int socket);

}  // namespace waitpoint::posix
