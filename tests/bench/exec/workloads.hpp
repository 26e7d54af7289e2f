// SPDX-License-Identifier: BSD-3-Clause
// Workloads of a program that runs natively and simulated: each executes one operation `count` times.
#pragma once

namespace waitpoint::bench {

struct Workload {
  const char* name;
  void (*run)(long count);
};

// Between two processes.
void hand_over_by_semaphores(long count);  ///< process-shared
void hand_over_by_pipes(long count);
void hand_over_by_tcp(long count);  ///< over the loopback
// Within a process.
void write_and_read(long count);  ///< a pipe, by one thread
void hand_over_by_pipes_of_threads(long count);
void hand_over_by_socket_pair(long count);
// The start and the end of a process.
void fork_and_wait(long count);
void spawn_and_wait(long count);

/// Ends the program if a call has failed.
void require(bool succeeded, const char* call);

}  // namespace waitpoint::bench
