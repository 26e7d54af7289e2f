// SPDX-License-Identifier: BSD-3-Clause
// Runs of a program by fork, from the point before main(): the program is loaded only once.
//
// The explorer requests each run by a packet over a socket, with the descriptors of its input and its output in it. The
// record, which all runs use in turn, holds the run's settings by then. The answers are the run's process id and, at
// its end, its status, as of waitpid(). The processes of its group that it has left behind are killed at a further
// packet, which is answered. A run whose process can make further ones ends otherwise: see rerun_control.hpp. All are
// killed, and the server ends, when the other end of the socket is closed.
#pragma once

#include <sys/types.h>

namespace waitpoint::posix {

/// The descriptors of a packet, in their order.
enum ServerDescriptor : int { run_input, run_output, run_descriptors };

/// Sent before the first request.
struct ServerReady {};

struct RunStarted {
  pid_t process;
};
struct RunEnded {
  int status;
};
/// No process of the run is left.
struct RunGone {};

/// Serves until the other end of the socket is closed, then ends the process. Returns in each run, in a process of its
/// own.
void serve_runs(int socket);
/// The same in a snapshot (snapshot.hpp): each request is preceded by a packet without descriptors, which is answered
/// once `prepare` has put the run's memory back.
void serve_runs_of_snapshot(int socket, void (*prepare)());

}  // namespace waitpoint::posix
