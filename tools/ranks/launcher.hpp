// SPDX-License-Identifier: BSD-3-Clause
// The start of a run of several processes on this host: `waitpoint run --ranks N` starts mpirun and waits for its end.
//
// mpirun reacts to a process that ends badly by signals to all others and pauses of seconds. Here it is told to leave
// that to the ranks, which watch each other (rank_processes.hpp) and give their exit status to this process directly.
#pragma once

#include <span>
#include <string>

namespace waitpoint::tools {

/// Advice to the user where ranks are missing.

/// True in one of several processes that mpirun has started.
bool is_rank();

/// Runs mpirun, which starts `ranks` processes of this program with the arguments. Returns the run's exit status.
/// Signals that are sent to this process go to the first rank. BadInput if there is no mpirun.
int run_ranks(int ranks, std::span<const std::string> arguments);

/// On a rank, once it is joined: where a signal goes.
void tell_launcher_of_leader();

/// Called last with the exit status of this process: if it is a rank of run_ranks(), gives it to that process. Returns
/// the status to exit with.
int give_status(int status);

}  // namespace waitpoint::tools
